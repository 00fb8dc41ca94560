// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/equations/force_set.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/formulations.h"
#include "tests/support/marker_motion.h"
#include "tests/support/tree_models.h"

using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

/// Checks one kind of force: the change of its stored energy must equal the power of its loads.
template <typename Keep>
void check_power(Keep&& keep) {
  Model model = forest();
  const Model all = forest();
  model.forces = {};
  keep(all, model);
  ForceSet forces(model);
  RandomNumbers random(91);
  std::vector<ForceMarker> start;
  for (std::size_t k = 0; k < forces.markers().size(); ++k) {
    ForceMarker& slot = forces.slot(k);
    slot.p = random.vector();
    slot.v = random.vector();
    slot.R = random.rotation().toRotationMatrix();
    slot.w = random.vector();
    start.push_back(slot);
  }
  const auto stored = [&](double t) {
    for (std::size_t k = 0; k < start.size(); ++k) {
      forces.slot(k).p = start[k].p + t * start[k].v;
      forces.slot(k).R = turned(t * start[k].w) * start[k].R;
    }
    forces.evaluate(0);
    return forces.stored_J();
  };
  constexpr double kTimeStep_s = 1e-3;
  const double rate = first_derivative(stored, kTimeStep_s);
  stored(0);
  double power = 0;
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
  for (std::size_t k = 0; k < start.size(); ++k) {
    const ForceMarker& slot = forces.slot(k);
    power += slot.force_N.dot(slot.v) + slot.moment_Nm.dot(slot.w);
    force += slot.force_N;
    moment += slot.moment_Nm + slot.p.cross(slot.force_N);
  }
  REQUIRE(std::abs(power) > 1e-2);
  REQUIRE(std::abs(rate) > 1e-3);
  // Differences of order 6 of energies of some joules.
  CHECK(power == Approx(-rate - forces.lost_W()).margin(1e-9));
  CHECK(forces.lost_W() >= 0);
  // Action equals reaction.
  CHECK(force.norm() < 1e-13);
  CHECK(moment.norm() < 1e-13);
}

/// A block of 2 kg that slides along x on a prismatic joint.
ModelBuilder sliding_block(double speed_m_s) {
  ModelBuilder build;
  const auto ground = build.ground();
  const auto block = build.body("block", RigidBody{2, Vector3d::Zero(), Matrix3d::Identity()}, {},
                                {speed_m_s, 0, 0});
  build.joint("rail", &kPrismaticJoint, build.marker("rail", ground), build.marker("block", block),
              Vector3d::UnitX());
  return build;
}

}  // namespace

TEST_CASE("what every force between bodies stores and loses is what its loads take in") {
  SECTION("springs") {
    check_power([](const Model& all, Model& model) {
      model.forces.of<MarkerSpring>() = all.forces.of<MarkerSpring>();
    });
  }
  SECTION("bushings") {
    check_power([](const Model& all, Model& model) {
      model.forces.of<Bushing>() = all.forces.of<Bushing>();
    });
  }
  SECTION("joint resistances across the axis") {
    check_power([](const Model& all, Model& model) {
      for (const JointResistance& each : all.forces.of<JointResistance>())
        if (each.coordinate != JointCoordinate::angle) model.forces.add(each);
    });
  }
}

TEST_CASE("friction stops a block where it must") {
  constexpr double kSpeed = 1.5;
  constexpr double kFriction_N = 4;
  constexpr double kFull = 0.05;
  ModelBuilder build = sliding_block(kSpeed);
  JointResistance brake{"brake", 0, JointCoordinate::distance, {}};
  brake.resistance.friction = kFriction_N;
  brake.resistance.full_rate = kFull;
  build.model.forces.add(brake);
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 3, .interval_s = 1.5});
  // Constant friction down to the full rate, then a decay of time constant m full / friction.
  const double mass = 2;
  const double expected = mass * (kSpeed * kSpeed - kFull * kFull) / (2 * kFriction_N) +
                          mass * kFull * kFull / kFriction_N;
  CHECK(history.marker("block").position_m(0, 2) == Approx(expected).epsilon(1e-7));
  CHECK(history.energy.dissipated_J[2] == Approx(mass * kSpeed * kSpeed / 2).epsilon(1e-7));
  // Friction is not part of the joint's reaction.
  CHECK(history.joint("rail").force_N.cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a stop with hysteresis gives back the share of energy that it is told to") {
  constexpr double kSpeed = 2;
  constexpr double kRatio = 0.3;
  constexpr double kStop_m = 0.05;
  ModelBuilder build = sliding_block(kSpeed);
  JointResistance buffer{"buffer", 0, JointCoordinate::distance, {}};
  buffer.resistance.positive.stop = kStop_m;
  buffer.resistance.positive.beyond_stop = LoadCurve::cubic(500, 0, 1e5);
  buffer.resistance.positive.unloading_ratio = kRatio;
  buffer.resistance.full_rate = 1e-4 * kSpeed;
  build.model.forces.add(buffer);
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 0.6, .interval_s = 1e-3});
  const Eigen::Index last = history.time_s.size() - 1;
  const double out = history.marker("block").velocity_m_s(0, last);
  REQUIRE(history.marker("block").position_m(0, last) < kStop_m);
  // The law reverses within 1e-4 of the speed: an error of the order of its square.
  CHECK(out * out / (kSpeed * kSpeed) == Approx(kRatio).epsilon(1e-6));
  CHECK(history.marker("block").position_m.row(0).maxCoeff() > kStop_m + 0.05);
  const Eigen::VectorXd balance =
      history.energy.kinetic_J + history.energy.strain_J + history.energy.dissipated_J;
  CHECK((balance.array() - balance[0]).abs().maxCoeff() < 1e-7 * balance[0]);
}

TEST_CASE("steps end where a stop is met and left, and the kinks cost neither order nor energy") {
  constexpr double kSpeed = 2;
  constexpr double kStop_m = 0.05;
  constexpr double kStiffness = 800;
  ModelBuilder build = sliding_block(kSpeed);
  JointResistance stops{"stops", 0, JointCoordinate::distance, {}};
  for (ResistanceSide* side : {&stops.resistance.positive, &stops.resistance.negative}) {
    side->stop = kStop_m;
    side->beyond_stop = LoadCurve::cubic(kStiffness);
  }
  build.model.forces.add(JointResistance{"idle", 0, JointCoordinate::distance, {}});
  build.model.forces.add(stops);
  // The path: to the stop, half a period of sqrt(m / k) in it, back through the middle to the other
  // one, half a period, and back to the start.
  const double swing_s = std::numbers::pi * std::sqrt(2 / kStiffness);
  const double round_s = 4 * kStop_m / kSpeed + 2 * swing_s;
  constexpr int kRounds = 3;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    CAPTURE(tolerance);
    const History history =
        simulate(build.model, solver_of(tolerance, 1e-3 * tolerance),
                 {.end_time_s = kRounds * round_s, .interval_s = kRounds * round_s});
    // There are some ten steps per oscillation, each with an error of the tolerance.
    CHECK(std::abs(history.marker("block").position_m(0, 1)) < 100 * tolerance * kStop_m);
    CHECK(history.marker("block").velocity_m_s(0, 1) == Approx(kSpeed).epsilon(100 * tolerance));
    int events = 0;
    for (const StepLimit& limit : history.statistics.limits)
      if (limit.what == "event: resistance 'stops': it reaches a stop or a kink of its curve")
        events = limit.steps;
    // Events are entering and leaving each stop; a second, short step if the first ended just
    // before the event.
    CHECK(events >= 4 * kRounds);
    CHECK(events <= 8 * kRounds);
  }
}

TEST_CASE("a block comes to rest in a hard stop at the end of a soft spring") {
  // A step chosen for the soft spring ends far beyond the stop, where the energy is much higher,
  // and the next one, chosen for the stop, far on the other side.
  constexpr double kStop_m = 0.05;
  constexpr double kHard = 1e6;
  constexpr double kPull_N = 10;
  ModelBuilder build = sliding_block(0);
  JointResistance buffer{"buffer", 0, JointCoordinate::distance, {}};
  buffer.resistance.positive.curve = LoadCurve::cubic(1);
  buffer.resistance.negative.curve = LoadCurve::cubic(1);
  buffer.resistance.positive.stop = kStop_m;
  buffer.resistance.positive.beyond_stop = LoadCurve::cubic(kHard);
  build.model.forces.add(buffer);
  build.model.forces.add(PointForce{"pull", build.model.marker_index("block"), Vector3d::UnitX(),
                                    TimeTable({0}, {kPull_N}, TimeTable::Outside::constant)});
  SolverOptions solver;
  solver.formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  const History history = settle(build.model, solver, {.end_time_s = 1, .interval_s = 1});
  CHECK(history.marker("block").position_m(0, 0) ==
        Approx((kPull_N + kHard * kStop_m) / (1 + kHard)).epsilon(1e-9));
}

TEST_CASE("a torque with a time table spins a rotor by its integral") {
  ModelBuilder build;
  const auto rotor =
      build.body("rotor", RigidBody{1, Vector3d::Zero(), 0.2 * Matrix3d::Identity()});
  build.model.forces.add(Torque{"motor", build.marker("rotor", rotor), Vector3d::UnitX(),
                                TimeTable({0, 1, 2}, {0, 6, 0}, TimeTable::Outside::zero)});
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 3, .interval_s = 1});
  CHECK(history.marker("rotor").angular_velocity_rad_s(0, 1) == Approx(3 / 0.2).epsilon(1e-9));
  CHECK(history.marker("rotor").angular_velocity_rad_s(0, 3) == Approx(6 / 0.2).epsilon(1e-9));
  CHECK(history.energy.work_J[3] == Approx(0.5 * 0.2 * 900).epsilon(1e-9));
}

TEST_CASE("a body on a bushing has the frequencies of its springs") {
  ModelBuilder build;
  const auto ground = build.ground();
  const Vector3d moments(0.02, 0.03, 0.04);
  const auto body = build.body("body", RigidBody{2, Vector3d::Zero(), moments.asDiagonal()});
  // The equilibrium needs a joint that carries the body, and rotations of a spherical joint and a
  // bushing.
  build.joint("ball", &kSphericalJoint, build.marker("ground", ground), build.marker("body", body));
  Bushing bushing{"bushing", 0, 1, {}, {}};
  bushing.stiffness.setZero();
  bushing.damping.setZero();
  const Vector3d stiffness(10, 20, 50);
  bushing.stiffness.diagonal().tail<3>() = stiffness;
  build.model.forces.add(bushing);
  const std::vector<SystemMode> modes = system_modes(build.model);
  REQUIRE(modes.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    CHECK(modes[k].frequency_Hz ==
          Approx(std::sqrt(stiffness[i] / moments[i]) / (2 * std::numbers::pi)).epsilon(1e-8));
  }
}

TEST_CASE("a spring that only pulls lets go when slack") {
  ModelBuilder build = sliding_block(-1);
  MarkerSpring rope{"rope", 0, 1, 0.5, {}};
  rope.resistance.positive.curve = LoadCurve::cubic(200);
  rope.resistance.tension_only = true;
  build.model.forces.add(rope);
  // Slack for 0.5 s, half a period sqrt(m / k) pi taut, then back at the same speed.
  const double half_period = std::numbers::pi * std::sqrt(2.0 / 200);
  const History history = simulate(build.model, solver_of(1e-10, 1e-13),
                                   {.end_time_s = 0.5 + half_period + 0.25, .interval_s = 0.25});
  const Eigen::Index last = history.time_s.size() - 1;
  CHECK(history.marker("block").position_m(0, 1) == Approx(-0.25).epsilon(1e-9));
  CHECK(history.marker("block").velocity_m_s(0, last) == Approx(1).epsilon(1e-7));
  CHECK(history.marker("block").position_m(0, last) == Approx(-0.25).epsilon(1e-6));
}

TEST_CASE("a permanent set is where a body rests") {
  ModelBuilder build;
  DeformableBody beam = deformable(make_beam_body(Beam{}), 0.1);
  beam.offset = Eigen::VectorXd::Zero(beam.modes.mode_count());
  beam.offset[0] = 0.02;
  const Vector3d bent = beam.modes.interface("top").position_m +
                        beam.modes.interface("top").translation * beam.offset;
  const auto ground = build.ground();
  const auto body = build.body("beam", beam);
  build.joint("root", &kFixedJoint, build.marker("ground", ground),
              build.interface_marker("base", body, "base"));
  build.interface_marker("top", body, "top");
  const OutputOptions output{.end_time_s = 0.1, .interval_s = 0.05};
  const History given = simulate(build.model, solver_of(1e-9, 1e-12), output);
  const History found = simulate_from_equilibrium(build.model, solver_of(1e-9, 1e-12), output);
  for (const History& history : {given, found})
    for (Eigen::Index k = 0; k < 3; ++k) {
      CHECK((history.marker("top").position_m.col(k) - bent).norm() < 1e-13);
      CHECK(history.energy.strain_J[k] < 1e-18);
    }
}

TEST_CASE("forces that make no sense are refused by name") {
  const auto refusal = [](auto&& spoil) {
    Model model = sliding_block(1).model;
    spoil(model);
    try {
      check(model);
    } catch (const flexneck::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refusal([](Model& m) {
               m.forces.add(Torque{"t", 7, Vector3d::UnitX(), {}});
             }),
             Contains("torque 't'") && Contains("marker"));
  CHECK_THAT(refusal([](Model& m) {
               m.forces.add(MarkerSpring{"s", 0, 0, 0.1, {}});
             }),
             Contains("spring 's'") && Contains("two bodies"));
  CHECK_THAT(refusal([](Model& m) {
               m.forces.add(JointResistance{"r", 0, JointCoordinate::angle, {}});
             }),
             Contains("resistance 'r'") && Contains("revolute"));
  CHECK_THAT(refusal([](Model& m) {
               m.forces.add(JointResistance{"r", 0, JointCoordinate::distance, {}});
               m.forces.of<JointResistance>().back().resistance.friction = 1;
             }),
             Contains("full_rate"));
  CHECK_THAT(refusal([](Model& m) {
               m.forces.add(Bushing{"b", 0, 1, {}, {}});
               m.forces.of<Bushing>().back().stiffness.setZero();
               m.forces.of<Bushing>().back().damping.setZero();
               m.forces.of<Bushing>().back().stiffness(0, 0) = -1;
             }),
             Contains("bushing 'b'") && Contains("eigenvalue"));
}
