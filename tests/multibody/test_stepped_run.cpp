// SPDX-License-Identifier: GPL-3.0-or-later
// Runs driven by the caller: from rest, with guards.
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/stepped_run.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using Eigen::Vector3d;
using namespace flexneck;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

constexpr double kMass = 2;         ///< kg
constexpr double kPush = 10;        ///< N along x
constexpr double kStiffness = 200;  ///< N/m

/// A block connected to the ground by a joint, with a force on it that is zero initially.
Model block(const JointKind* kind, const Vector3d& center_m) {
  ModelBuilder build;
  build.ground();
  build.body("block", RigidBody{kMass, center_m, Eigen::Matrix3d::Identity()});
  build.marker("ground.at", 0);
  build.marker("block.at", 1);
  if (kind != nullptr) build.joint("joint", kind, 0, 1, Vector3d::UnitX());
  build.force("push", 1, Vector3d::UnitX(), constant_table(0));
  build.model.gravity_m_s2.setZero();
  return build.model;
}

struct Resting {
  const char* name;
  Model model;
  std::function<double(double)> x_m;  ///< x of marker block.at, with the push from time zero on
};

std::vector<Resting> resting() {
  const auto pushed = [](double t) { return 0.5 * kPush / kMass * t * t; };
  const auto stays = [](double) { return 0.; };
  std::vector<Resting> all;
  all.push_back({"a block on a rail", block(&kPrismaticJoint, Vector3d::Zero()), pushed});
  all.push_back({"a free block", block(nullptr, Vector3d::Zero()), pushed});
  all.push_back({"a block that is fixed", block(&kFixedJoint, Vector3d::Zero()), stays});
  all.push_back({"a pendulum that hangs", block(&kRevoluteJoint, {0, 0, -0.3}), stays});
  all.back().model.gravity_m_s2 = {0, 0, -9.81};
  all.push_back({"a block in free fall", block(nullptr, Vector3d::Zero()), pushed});
  all.back().model.gravity_m_s2 = {0, 0, -9.81};
  all.push_back({"a block on a spring", block(&kPrismaticJoint, Vector3d::Zero()), [](double t) {
                   return kPush / kStiffness * (1 - std::cos(std::sqrt(kStiffness / kMass) * t));
                 }});
  JointResistance spring{"spring", 0, JointCoordinate::distance, {}};
  for (ResistanceSide* side : {&spring.resistance.positive, &spring.resistance.negative})
    side->curve = LoadCurve::cubic(kStiffness);
  all.back().model.forces.add(spring);
  return all;
}

}  // namespace

TEST_CASE("a run that is stepped at rest goes on, and moves once it is pushed") {
  SolverOptions solver = solver_of(1e-8, 1e-11);
  solver.integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  solver.max_steps = 100'000;  // a step control that hangs ends
  for (const Resting& each : resting()) {
    INFO(each.name);
    SteppedRun run(each.model, solver, SteppedRun::Kind::motion);
    const std::size_t push = inputs_of(each.model).size() - 1;
    for (int step = 1; step <= 6; ++step) {
      if (step == 3) run.set_input(push, kPush);
      REQUIRE_NOTHROW(run.advance(0.1 * step));
    }
    const double tolerance = solver.integrator == Integrator::dormand_prince ? 1e-7 : 1e-5;
    CHECK(run.output().marker("block.at").position_m(0, 0) ==
          Approx(each.x_m(0.4)).margin(tolerance));
  }
}

TEST_CASE("a stepped run ends where a bushing turns too far between two of its steps") {
  const SolverOptions solver = solver_of(1e-8, 1e-11);
  ModelBuilder build;
  build.ground();
  build.body("wheel", RigidBody{1, Vector3d::Zero(), 0.2 * Eigen::Matrix3d::Identity()}, {},
             Vector3d::Zero(), {0, 40, 0});
  build.marker("ground.at", 0);
  build.marker("wheel.at", 1);
  Bushing bushing;
  bushing.name = "rubber";
  bushing.marker_i = 0;
  bushing.marker_j = 1;
  bushing.stiffness.diagonal().tail<3>().setConstant(5);
  build.model.forces.add(std::move(bushing));
  build.model.gravity_m_s2.setZero();
  SteppedRun run(build.model, solver, SteppedRun::Kind::motion);
  const Eigen::VectorXd before = run.state().y;
  // 40/5 sin(5 t) rad would pass 3 rad at 0.077 s.
  CHECK_THROWS_WITH(run.advance(1.8), Catch::Matchers::Contains("bushing 'rubber'") &&
                                          Catch::Matchers::Contains("3 rad at 0.07"));
  CHECK(run.state().y == before);
  CHECK_NOTHROW(run.advance(0.07));
}
