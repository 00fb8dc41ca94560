// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/in_parallel.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
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

TEST_CASE("runs in parallel give the bits that they give one by one") {
  const std::vector<Model> models = {pendulum(100), pendulum(150), pendulum(200)};
  constexpr std::size_t kRuns = 12;
  const auto run = [&](std::size_t k) {
    const OutputOptions output{.end_time_s = 0.05, .interval_s = 0.01};
    const Model& model = models[k % models.size()];
    return k / models.size() % 2 == 0 ? simulate_from_equilibrium(model, {}, output)
                                      : simulate(model, {}, output);
  };
  std::vector<History> together(kRuns);
  flexneck::in_parallel(kRuns, 3, [&](std::size_t k) { together[k] = run(k); });
  for (std::size_t k = 0; k < kRuns; ++k) {
    const History alone = run(k);
    CHECK(together[k].marker("head cg").position_m == alone.marker("head cg").position_m);
    CHECK(together[k].joint("OC").moment_Nm == alone.joint("OC").moment_Nm);
    CHECK(together[k].statistics.evaluations == alone.statistics.evaluations);
  }
  CHECK(together[0].marker("head cg").position_m != together[1].marker("head cg").position_m);
}
