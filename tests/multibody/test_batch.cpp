// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/simulation/batch.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

/// A neck on an arm with a variable deceleration.
Model pendulum(double deceleration_m_s2) {
  const TimeTable pulse({0, 0.01, 0.03}, {0, -deceleration_m_s2, 0}, TimeTable::Outside::zero);
  ModelBuilder build =
      head_on_neck({Vector3d::UnitX(), 5, pulse}, hanging_pose(), Beam{}, 0.9, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

}  // namespace

TEST_CASE("a batch gives the bits that its runs give one by one, in their order") {
  const std::vector<Model> models = {pendulum(100), pendulum(150), pendulum(200)};
  const OutputOptions output{.end_time_s = 0.05, .interval_s = 0.01};
  std::vector<BatchRun> runs;
  for (int repeat = 0; repeat < 4; ++repeat)
    for (const Model& model : models) runs.push_back({&model, {}, output, repeat % 2 == 0});
  const std::vector<BatchResult> results = simulate_batch(runs, 3);
  REQUIRE(results.size() == runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const BatchRun& run = runs[k];
    const History alone = run.from_equilibrium
                              ? simulate_from_equilibrium(*run.model, run.solver, run.output)
                              : simulate(*run.model, run.solver, run.output);
    CHECK(results[k].error.empty());
    CHECK(results[k].history.marker("head cg").position_m == alone.marker("head cg").position_m);
    CHECK(results[k].history.joint("OC").moment_Nm == alone.joint("OC").moment_Nm);
    CHECK(results[k].history.statistics.evaluations == alone.statistics.evaluations);
  }
  CHECK(results[0].history.marker("head cg").position_m !=
        results[1].history.marker("head cg").position_m);
}

TEST_CASE("a run that fails stops no other run of its batch") {
  const Model good = pendulum(100);
  Model bad = good;
  std::get<RigidBody>(bad.bodies[2].kind).mass_kg = -1;
  SolverOptions hurried;
  hurried.max_steps = 3;
  const OutputOptions output{.end_time_s = 0.05, .interval_s = 0.001};
  const auto results = simulate_batch(
      {{&good, {}, output}, {&bad, {}, output}, {&good, hurried, output}, {&good, {}, output}}, 2);
  CHECK(results[0].error.empty());
  CHECK_THAT(results[1].error, Contains("mass must be positive"));
  CHECK_THAT(results[2].error, Contains("given up"));
  CHECK(results[2].history.incomplete == results[2].error);
  CHECK(results[2].history.time_s.size() < results[3].history.time_s.size());
  CHECK(results[3].history.marker("head cg").position_m ==
        results[0].history.marker("head cg").position_m);
  CHECK(simulate_batch({}, 2).empty());
  CHECK_THROWS_AS(simulate_batch({{&good, {}, output}}, 0), flexneck::InputError);
}
