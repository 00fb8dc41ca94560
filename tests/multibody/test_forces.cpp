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

/// A force of one kind alone: what it stores must change by what its loads take in.
template <typename Keep>
void check_power(Keep&& keep) {
  Model model = forest();
  const Model all = forest();
  model.forces.clear();
  model.torques.clear();
  model.springs.clear();
  model.bushings.clear();
  model.resistances.clear();
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
  constexpr double kStep = 1e-3;
  const double rate = first_derivative(stored, kStep);
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
  // Action is reaction.
  CHECK(force.norm() < 1e-13);
  CHECK(moment.norm() < 1e-13);
}

/// A block of 2 kg that slides along x on a slider joint.
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
    check_power([](const Model& all, Model& model) { model.springs = all.springs; });
  }
  SECTION("bushings") {
    check_power([](const Model& all, Model& model) { model.bushings = all.bushings; });
  }
  SECTION("joint resistances across the axis") {
    check_power([](const Model& all, Model& model) {
      for (const JointResistance& each : all.resistances)
        if (each.coordinate != JointCoordinate::angle) model.resistances.push_back(each);
    });
  }
}

TEST_CASE("a load curve is its table or its cubic, and its energy the integral") {
  const LoadCurve table = LoadCurve::table({0, 0.1, 0.3}, {0, 5, 6});
  CHECK(table.value(0.05) == Approx(2.5));
  CHECK(table.value(0.2) == Approx(5.5));
  CHECK(table.value(0.5) == Approx(7));
  CHECK(table.energy(0.3) == Approx(0.25 + 1.1));
  CHECK(table.energy(0.5) == Approx(0.25 + 1.1 + 1.3));
  const LoadCurve cubic = LoadCurve::cubic(3, 4, 5);
  CHECK(cubic.value(0.2) == Approx(0.6 + 0.16 + 0.04));
  CHECK(cubic.energy(0.2) == Approx(3 * 0.04 / 2 + 4 * 0.008 / 3 + 5 * 0.0016 / 4));
  CHECK(LoadCurve().value(1) == 0);
  CHECK_THROWS_WITH(LoadCurve::table({0, 0.1, 0.1}, {0, 1, 2}), Contains("row 3"));
  CHECK_THROWS_WITH(LoadCurve::table({0.1, 0.2}, {0, 1}), Contains("first row"));
}

TEST_CASE("a resistance loads and unloads each of its sides by that side's own law") {
  Resistance resistance;
  resistance.positive.curve = LoadCurve::cubic(100);
  resistance.positive.stop = 0.2;
  resistance.positive.beyond_stop = LoadCurve::cubic(400);
  resistance.positive.unloading_ratio = 0.5;
  resistance.negative.curve = LoadCurve::table({0, 0.1, 0.5}, {0, 5, 12});
  resistance.damping = 0.4;
  resistance.friction = 0.8;
  resistance.full_rate = 2;
  Resistance mirrored = resistance;
  std::swap(mirrored.positive, mirrored.negative);
  struct Expected {
    double x, v, load, stored_J, lost_W;
  };
  // Loaded 30 + 40 N, at rest 3/4 of it; at half the full rate half of what is lost besides 0.4 v.
  const double at_rest_N = 0.75 * 70;
  const double stored_J = 0.75 * (4.5 + 2);
  for (const Expected& at : {Expected{0.3, 1, at_rest_N + 8.75 + 0.4 + 0.4, stored_J, 9.55},
                             {0.3, -4, at_rest_N - 17.5 - 1.6 - 0.8, stored_J, 4 * 19.9},
                             {-0.3, 1, -8.5 + 0.4 + 0.4, 0.25 + 1.35, 0.8},
                             {-0.3, -4, -8.5 - 1.6 - 0.8, 0.25 + 1.35, 4 * 2.4}}) {
    CAPTURE(at.x, at.v);
    const ResistanceLoad found = evaluate(resistance, at.x, at.v);
    CHECK(found.load == Approx(at.load));
    CHECK(found.stored_J == Approx(at.stored_J));
    CHECK(found.lost_W == Approx(at.lost_W));
    const ResistanceLoad image = evaluate(mirrored, -at.x, -at.v);
    CHECK(image.load == Approx(-at.load));
    CHECK(image.stored_J == Approx(at.stored_J));
    CHECK(image.lost_W == Approx(at.lost_W));
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
  build.model.resistances.push_back(brake);
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 3, .interval_s = 1.5});
  // Constant friction down to the full rate, then a decay of time constant m full / friction.
  const double mass = 2;
  const double expected = mass * (kSpeed * kSpeed - kFull * kFull) / (2 * kFriction_N) +
                          mass * kFull * kFull / kFriction_N;
  CHECK(history.marker("block").position_m(0, 2) == Approx(expected).epsilon(1e-7));
  CHECK(history.energy.dissipated_J[2] == Approx(mass * kSpeed * kSpeed / 2).epsilon(1e-7));
  // Friction is no part of the joint's reaction.
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
  build.model.resistances.push_back(buffer);
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 0.6, .interval_s = 1e-3});
  const Eigen::Index last = history.time_s.size() - 1;
  const double out = history.marker("block").velocity_m_s(0, last);
  REQUIRE(history.marker("block").position_m(0, last) < kStop_m);
  // The law turns over within 1e-4 of the speed: an error of the order of its square.
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
  build.model.resistances.push_back({"idle", 0, JointCoordinate::distance, {}});
  build.model.resistances.push_back(stops);
  // To the stop, half a swing of sqrt(m / k) in it, back through the middle to the other one, half
  // a swing, and back to where it began.
  const double swing_s = std::numbers::pi * std::sqrt(2 / kStiffness);
  const double round_s = 4 * kStop_m / kSpeed + 2 * swing_s;
  constexpr int kRounds = 3;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    CAPTURE(tolerance);
    const History history =
        simulate(build.model, solver_of(tolerance, 1e-3 * tolerance),
                 {.end_time_s = kRounds * round_s, .interval_s = kRounds * round_s});
    // Some ten steps a swing, each with an error of the tolerance.
    CHECK(std::abs(history.marker("block").position_m(0, 1)) < 100 * tolerance * kStop_m);
    CHECK(history.marker("block").velocity_m_s(0, 1) == Approx(kSpeed).epsilon(100 * tolerance));
    int events = 0;
    for (const StepLimit& limit : history.statistics.limits)
      if (limit.what == "event: resistance 'stops': a stop or a kink of its curve")
        events = limit.steps;
    // Into and out of each; a second, short step where the first ended just before the event.
    CHECK(events >= 4 * kRounds);
    CHECK(events <= 8 * kRounds);
  }
}

TEST_CASE("a block comes to rest in a hard stop at the end of a soft spring") {
  // A step by the soft spring's stiffness ends far beyond the stop, where the energy is much
  // higher, and the next one by the stop's far on the other side.
  constexpr double kStop_m = 0.05;
  constexpr double kHard = 1e6;
  constexpr double kPull_N = 10;
  ModelBuilder build = sliding_block(0);
  JointResistance buffer{"buffer", 0, JointCoordinate::distance, {}};
  buffer.resistance.positive.curve = LoadCurve::cubic(1);
  buffer.resistance.negative.curve = LoadCurve::cubic(1);
  buffer.resistance.positive.stop = kStop_m;
  buffer.resistance.positive.beyond_stop = LoadCurve::cubic(kHard);
  build.model.resistances.push_back(buffer);
  build.model.forces.push_back({"pull", build.model.marker_index("block"), Vector3d::UnitX(),
                                TimeTable({0}, {kPull_N}, TimeTable::Outside::constant)});
  SolverOptions solver;
  solver.formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  const History history = settle(build.model, solver, {.end_time_s = 1, .interval_s = 1});
  CHECK(history.marker("block").position_m(0, 0) ==
        Approx((kPull_N + kHard * kStop_m) / (1 + kHard)).epsilon(1e-9));
}

TEST_CASE("a law's pieces change where its load has a kink, and nowhere else") {
  Resistance resistance;
  resistance.positive.curve = LoadCurve::table({0, 0.1, 0.3}, {0, 5, 6});
  resistance.positive.stop = 0.2;
  resistance.positive.beyond_stop = LoadCurve::cubic(1, 2, 3);
  resistance.negative.curve = LoadCurve::cubic(30);
  resistance.friction = GENERATE(0.0, 2.0);
  resistance.full_rate = 0.5;
  const auto slope = [&](double x, double v, bool along_rate) {
    const auto load = [&](double step) {
      return evaluate(resistance, x + (along_rate ? 0 : step), v + (along_rate ? step : 0)).load;
    };
    return first_derivative(load, 1e-5);
  };
  const auto same = [&](double x, double v, double y, double w) {
    const LawPiece one = piece_of(resistance, x, v);
    const LawPiece other = piece_of(resistance, y, w);
    return one.deflection == other.deflection && one.rate == other.rate;
  };
  for (const double kink : {0.0, 0.1, 0.2}) {
    CAPTURE(kink);
    CHECK_FALSE(same(kink - 1e-3, 0.1, kink + 1e-3, 0.1));
    CHECK(std::abs(slope(kink - 1e-3, 0.1, false) - slope(kink + 1e-3, 0.1, false)) > 0.5);
  }
  for (const auto& [from, to] : {std::pair(-0.4, -0.01), {0.01, 0.09}, {0.11, 0.19}, {0.21, 0.29}})
    CHECK(same(from, 0.1, to, 0.1));
  CHECK(same(0.15, 0.49, 0.15, 0.51) == (resistance.friction == 0));
  CHECK(same(0.15, -0.49, 0.15, -0.51) == (resistance.friction == 0));
  CHECK(same(0.15, -0.4, 0.15, 0.4));
  // The same line on both sides has no kink at zero; a rope has.
  resistance.positive = resistance.negative;
  CHECK(same(-1, 0.1, 1, 0.1));
  resistance.positive.curve = LoadCurve::table({0, 0.5, 1}, {0, 15, 16});
  resistance.negative.curve = LoadCurve::table({0, 0.2, 1}, {0, 6, 36});
  CHECK(same(-0.1, 0.1, 0.1, 0.1));
  resistance.negative.curve = LoadCurve::table({0, 0.2, 1}, {0, 7, 36});
  CHECK_FALSE(same(-0.1, 0.1, 0.1, 0.1));
  resistance.tension_only = true;
  CHECK_FALSE(same(-1, 0.1, 1, 0.1));
}

TEST_CASE("a torque with a time table spins a rotor by its integral") {
  ModelBuilder build;
  const auto rotor =
      build.body("rotor", RigidBody{1, Vector3d::Zero(), 0.2 * Matrix3d::Identity()});
  build.model.torques.push_back({"motor", build.marker("rotor", rotor), Vector3d::UnitX(),
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
  // The equilibrium needs a joint that carries; a ball and a bushing's rotations.
  build.joint("ball", &kSphericalJoint, build.marker("ground", ground), build.marker("body", body));
  Bushing bushing{"bushing", 0, 1, {}, {}};
  bushing.stiffness.setZero();
  bushing.damping.setZero();
  const Vector3d stiffness(10, 20, 50);
  bushing.stiffness.diagonal().tail<3>() = stiffness;
  build.model.bushings.push_back(bushing);
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
  build.model.springs.push_back(rope);
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
               m.torques.push_back({"t", 7, Vector3d::UnitX(), {}});
             }),
             Contains("torque 't'") && Contains("marker"));
  CHECK_THAT(refusal([](Model& m) {
               m.springs.push_back({"s", 0, 0, 0.1, {}});
             }),
             Contains("spring 's'") && Contains("two bodies"));
  CHECK_THAT(refusal([](Model& m) {
               m.resistances.push_back({"r", 0, JointCoordinate::angle, {}});
             }),
             Contains("resistance 'r'") && Contains("revolute"));
  CHECK_THAT(refusal([](Model& m) {
               m.resistances.push_back({"r", 0, JointCoordinate::distance, {}});
               m.resistances.back().resistance.friction = 1;
             }),
             Contains("full_rate"));
  CHECK_THAT(refusal([](Model& m) {
               m.bushings.push_back({"b", 0, 1, {}, {}});
               m.bushings.back().stiffness.setZero();
               m.bushings.back().damping.setZero();
               m.bushings.back().stiffness(0, 0) = -1;
             }),
             Contains("bushing 'b'") && Contains("eigenvalue"));
}
