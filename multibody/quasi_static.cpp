// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "geometry/foundation/error.h"
#include "multibody/motion.h"
#include "multibody/recorder.h"

namespace flexneck::multibody {
namespace {

/// What forces and driven bodies have done where nothing is lost: what the energies have gained.
void set_work(EnergyHistory& energy) {
  energy.work_J = energy.kinetic_J + energy.gravitational_J + energy.strain_J;
  if (energy.work_J.size() > 0) energy.work_J.array() -= double(energy.work_J[0]);
}

}  // namespace

History settle_along(const Model& model, Equations& equations, const OutputOptions& output) {
  Recorder recorder(model, output_times(output));
  const auto count = [&] { recorder.statistics().evaluations = equations.evaluations(); };
  Eigen::Index column = 0;
  try {
    Eigen::VectorXd state = equations.given_place();
    for (; column < recorder.columns(); ++column) {
      const double time_s = recorder.time_s(column);
      equations.settle(time_s, state);
      Eigen::VectorXd recorded = state;
      equations.record(time_s, recorded, recorder, column);
      if (column == 0) recorder.redundant(equations.redundant_constraints());
    }
  } catch (const ComputationError& error) {
    count();
    const std::string why =
        std::string(error.what()) + ", at " + std::to_string(recorder.time_s(column)) + " s";
    History history = recorder.take_incomplete(column, why);
    set_work(history.energy);
    throw IncompleteRun(why, history);
  }
  count();
  History history = recorder.take();
  set_work(history.energy);
  return history;
}

}  // namespace flexneck::multibody
