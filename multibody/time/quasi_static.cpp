// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "geometry/foundation/error.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/time/motion.h"

namespace flexneck::multibody {

History settle_along(const Model& model, Equations& equations,
                     const std::function<void()>& checkpoint, const OutputOptions& output) {
  Recorder recorder(model, output);
  const auto count = [&] { recorder.statistics().evaluations = equations.evaluations(); };
  Eigen::Index column = 0;
  try {
    Eigen::VectorXd state = equations.given_place();
    for (; column < recorder.columns(); ++column) {
      const double time_s = recorder.time_s(column);
      equations.settle(time_s, state);
      Eigen::VectorXd recorded = state;
      recorder.begin(column);
      equations.record(time_s, recorded, recorder, column);
      recorder.check_turns(column);
      recorder.conserve_energy(column);
      if (column == 0)
        recorder.mobility(equations.freedoms(), equations.redundant_constraints(),
                          equations.doubts());
      if (checkpoint) checkpoint();
    }
  } catch (const ComputationError& error) {
    count();
    const std::string why =
        std::string(error.what()) + ", at " + std::to_string(recorder.time_s(column)) + " s";
    throw IncompleteRun(why, recorder.take_incomplete(column, why));
  }
  count();
  return recorder.take();
}

}  // namespace flexneck::multibody
