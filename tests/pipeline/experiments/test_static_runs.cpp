// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/simulation/simulation.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/static_tables.h"
#include "pipeline/experiments/static_test.h"
#include "tests/support/beam_experiment.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

/// Deflection and rotation of the top in the plane under a unit force, K^-1 f of the modal body.
std::array<double, 2> compliance(const fe_modal::ModalBody& body, Eigen::Index along,
                                 Eigen::Index about) {
  const fe_modal::Interface& top = body.interface("top");
  std::array<double, 2> sum{};
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const double omega = 2 * std::numbers::pi * body.frequencies_Hz[k];
    const double a = top.translation(along, k) / (omega * omega);
    sum[0] += top.translation(along, k) * a;
    sum[1] += top.rotation(about, k) * a;
  }
  return sum;
}

constexpr double kNewton = 400 * 4.4482216152605;

}  // namespace

TEST_CASE("at rest the tester shows K^-1 f in every direction") {
  const testing::BeamExperiment experiment;
  for (const auto& [name, along, about, sense, turn] :
       {std::tuple("flexion", 0, 1, 1.0, 1.0), std::tuple("extension", 0, 1, -1.0, 1.0),
        std::tuple("lateral", 1, 0, 1.0, -1.0)}) {
    INFO(name);
    const CaseSection& section = experiment.named(name);
    const multibody::Model model = case_model(section, experiment.body);
    const StaticTestSignals signals =
        static_test_signals(model, settled_static_test(experiment.study, section, model), section);
    const auto [deflection, rotation] = compliance(experiment.body, along, about);
    const Eigen::Index last = signals.load.size() - 1;
    CHECK(signals.load[last] == Approx(kNewton).epsilon(1e-12));
    // The body is linear: results are proportional to the load. A rotation towards +y is one about
    // -x.
    for (const Eigen::Index k : {last / 4, last}) {
      const double force = sense * signals.load[k];
      CHECK(signals.deflection[k] == Approx(deflection * force).epsilon(1e-7));
      CHECK(signals.rotation[k] == Approx(turn * rotation * force).epsilon(1e-7));
    }
  }
}

TEST_CASE("the moving ramp lags by the damping of the modes") {
  const testing::BeamExperiment experiment;
  StaticEntry entry;
  entry.experiment = experiment.named("flexion");
  const multibody::Model model = case_model(entry.experiment, experiment.body);
  entry.ramp = static_test_signals(
      model, multibody::simulate(model, experiment.study.solver, {2.0, 5e-4}), entry.experiment);
  entry.settled = static_test_signals(
      model, settled_static_test(experiment.study, entry.experiment, model), entry.experiment);
  const ResultTable table = ramp_table({entry});
  // A mode lags by 2 zeta / omega; the rotation by the mean of that, weighted with each mode's
  // contribution.
  const double ratio = experiment.study.model.of_structure.begin()->second.damping_ratio.value();
  const fe_modal::Interface& top = experiment.body.interface("top");
  double lagging = 0;
  double whole = 0;
  for (Eigen::Index k = 0; k < experiment.body.mode_count(); ++k) {
    const double omega = 2 * std::numbers::pi * experiment.body.frequencies_Hz[k];
    const double part = top.translation(0, k) * top.rotation(1, k) / (omega * omega);
    whole += part;
    lagging += 2 * ratio / omega * part;
  }
  REQUIRE(table.columns.back().name == "lag");
  CHECK(std::stod(table.rows.at(0).back()) == Approx(1e3 * lagging / whole).epsilon(0.002));
}
