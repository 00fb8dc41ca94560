// SPDX-License-Identifier: GPL-3.0-or-later
// Stops, grazing, bounces, ropes and friction between bodies, against their closed forms and the
// balance of energy: both integrators, both formulations, tolerances and largest steps of any size.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/campaigns/campaign.h"
#include "tests/campaigns/draws.h"
#include "tests/support/piecewise_motion.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using flexneck::campaigns::Case;
using flexneck::campaigns::direction;
using flexneck::campaigns::log_between;

namespace {

constexpr int kOutputs = 40;

/// A model, and its coordinate in closed form.
struct Problem {
  Model model;
  double end_s = 1;
  std::vector<double> expected;  ///< expected coordinate at the outputs
  std::function<double(const History&, Eigen::Index)> coordinate;
  double size = 1;
  int kinks = 0;
  double stiffest_rad_s = 0;  ///< largest frequency of the stops and ropes that were met
};

void expect(Problem& problem, PiecewiseMotion motion) {
  for (int k = 0; k <= kOutputs; ++k) {
    problem.expected.push_back(motion.x());
    problem.size = std::max(problem.size, std::abs(motion.x()));
    motion.advance(problem.end_s / kOutputs);
  }
  problem.kinks = motion.kinks();
}

/// A slider or a rotor under a constant load, between one or two stops; one in three grazes a stop.
Problem stops(Case& drawn) {
  const bool slides = drawn.chance(0.6);
  const double inertia = log_between(drawn, 0.1, 10);
  const double load = drawn.between(-10, 10) * inertia;
  const double acceleration = load / inertia;
  double speed = drawn.between(-4, 4);
  double upper = drawn.between(0.2, 2);
  const double lower = drawn.between(0.2, 2);
  const bool has_lower = drawn.chance(0.7);
  Problem problem;
  problem.end_s = drawn.between(0.5, 2);
  if (drawn.chance(0.33) && acceleration < -1 && speed > 0.5) {
    const double apex = speed * speed / (-2 * acceleration);
    upper = apex - log_between(drawn, 1e-6, 0.05) * std::min(1.0, apex);
  }
  // A rotor stays within half a turn of its stops.
  const double stiffness = inertia * log_between(drawn, 1e2, 1e7);
  ModelBuilder build;
  const auto ground = build.ground();
  const Vector3d axis = direction(drawn);
  const auto body = build.body(
      "b", RigidBody{slides ? inertia : 1, Vector3d::Zero(), inertia * Matrix3d::Identity()}, {},
      slides ? Vector3d(speed * axis) : Vector3d::Zero(),
      slides ? Vector3d::Zero() : Vector3d(speed * axis));
  const auto origin = build.marker("o", ground);
  const auto center = build.marker("c", body);
  build.joint("j", slides ? &kPrismaticJoint : &kRevoluteJoint, origin, center, axis);
  JointResistance law{"stops", 0, slides ? JointCoordinate::distance : JointCoordinate::angle, {}};
  law.resistance.positive.stop = upper;
  law.resistance.positive.beyond_stop = LoadCurve::cubic(stiffness);
  std::vector<PiecewiseMotion::Spring> springs{{upper, 1, stiffness / inertia}};
  if (has_lower) {
    law.resistance.negative.stop = lower;
    law.resistance.negative.beyond_stop = LoadCurve::cubic(stiffness);
    springs.push_back({-lower, -1, stiffness / inertia});
  }
  build.model.forces.add(law);
  if (slides)
    build.force("push", center, axis, constant_table(load));
  else
    build.model.forces.add(Torque{"push", center, axis, constant_table(load)});
  problem.model = build.model;
  problem.stiffest_rad_s = std::sqrt(stiffness / inertia);
  expect(problem, PiecewiseMotion(acceleration, springs, 0, speed));
  if (slides) {
    problem.coordinate = [axis](const History& history, Eigen::Index k) {
      return axis.dot(history.marker("c").position_m.col(k));
    };
  } else {
    // The rotation at an output is compared modulo full turns.
    problem.coordinate = [axis](const History& history, Eigen::Index k) {
      const Quaterniond q = rotation_at(history.marker("c").rotation, k);
      return 2 * std::atan2(q.vec().dot(axis), q.w());
    };
    for (double& angle : problem.expected) angle = std::remainder(angle, 4 * std::numbers::pi);
  }
  return problem;
}

/// Two free bodies connected by a rope, which tightens once or repeatedly.
Problem rope(Case& drawn) {
  const double mass_i = log_between(drawn, 0.1, 10);
  const double mass_j = log_between(drawn, 0.1, 10);
  const double reduced = mass_i * mass_j / (mass_i + mass_j);
  const double length = drawn.between(0.5, 2);
  const double start = length * drawn.between(0.3, 0.95);
  const double speed = drawn.between(0.5, 4);
  const double stiffness = reduced * log_between(drawn, 1e2, 1e7);
  const Vector3d along = direction(drawn);
  const Vector3d common = drawn.between(0, 2) * direction(drawn);
  ModelBuilder build;
  build.ground();
  const auto body = [&](const char* name, double mass, double place, double velocity) {
    return build.body(name, RigidBody{mass, Vector3d::Zero(), mass * Matrix3d::Identity()},
                      {Vector3d(place * along)}, common + velocity * along);
  };
  const auto i = body("i", mass_i, 0, 0);
  const auto j = body("j", mass_j, start, speed);
  const auto marker_i = build.marker("i", i);
  const auto marker_j = build.marker("j", j);
  MarkerSpring spring{"rope", marker_i, marker_j, length, {}};
  spring.resistance.positive.curve = LoadCurve::cubic(stiffness);
  spring.resistance.tension_only = true;
  build.model.forces.add(spring);
  Problem problem;
  // The run ends when they are back at a quarter of the rope's length: further on they would pass
  // each other.
  problem.end_s = (length - start) / speed + 0.75 * length / speed;
  problem.model = build.model;
  problem.stiffest_rad_s = std::sqrt(stiffness / reduced);
  expect(problem, PiecewiseMotion(0, {{length, 1, stiffness / reduced}}, start, speed));
  problem.coordinate = [along](const History& history, Eigen::Index k) {
    return along.dot(history.marker("j").position_m.col(k) - history.marker("i").position_m.col(k));
  };
  return problem;
}

/// A block that friction brakes while a force pushes it: constant rates above the full rate, decays
/// below.
Problem friction(Case& drawn) {
  const double mass = log_between(drawn, 0.1, 10);
  const double full = log_between(drawn, 1e-3, 0.3);
  const double brake = mass * drawn.between(1, 10);
  const double push = brake * drawn.between(-0.5, 0.9);
  const double speed = full + drawn.between(0.1, 3);
  const Vector3d axis = direction(drawn);
  ModelBuilder build;
  const auto ground = build.ground();
  const auto body = build.body("b", RigidBody{mass, Vector3d::Zero(), mass * Matrix3d::Identity()},
                               {}, speed * axis);
  const auto origin = build.marker("o", ground);
  const auto center = build.marker("c", body);
  build.joint("j", &kPrismaticJoint, origin, center, axis);
  JointResistance law{"brake", 0, JointCoordinate::distance, {}};
  law.resistance.friction = brake;
  law.resistance.full_rate = full;
  build.model.forces.add(law);
  build.force("push", center, axis, constant_table(push));
  Problem problem;
  problem.model = build.model;
  const double braking = (brake - push) / mass;
  const double to_full_s = (speed - full) / braking;
  problem.end_s = to_full_s * drawn.between(1.1, 3);
  const double creep = push / brake * full;
  const double rate = brake / (mass * full);
  for (int k = 0; k <= kOutputs; ++k) {
    const double t = problem.end_s * k / kOutputs;
    const double first = std::min(t, to_full_s);
    const double then = t - first;
    problem.expected.push_back(first * (speed - first * braking / 2) + creep * then -
                               (full - creep) / rate * std::expm1(-rate * then));
    problem.size = std::max(problem.size, problem.expected.back());
  }
  problem.kinks = 1;
  problem.coordinate = [axis](const History& history, Eigen::Index k) {
    return axis.dot(history.marker("c").position_m.col(k));
  };
  return problem;
}

double largest_error(const Problem& problem, const History& history) {
  double worst = 0;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k)
    worst = std::max(worst, std::abs(problem.coordinate(history, k) -
                                     problem.expected[static_cast<std::size_t>(k)]));
  return worst;
}

/// Largest change of the energy balance over the largest energy.
double energy_error(const EnergyHistory& energy) {
  const Eigen::VectorXd balance = energy.kinetic_J + energy.gravitational_J + energy.strain_J +
                                  energy.dissipated_J - energy.work_J;
  const double largest =
      std::max({energy.kinetic_J.maxCoeff(), energy.strain_J.maxCoeff(),
                energy.dissipated_J.maxCoeff(), energy.work_J.cwiseAbs().maxCoeff()});
  return (balance.array() - balance[0]).abs().maxCoeff() / largest;
}

/// Allowed error: each kink carries errors on at the speed of the motion. The implicit method's
/// tolerance is that of displacements: in a contact they become errors of speed by its frequency,
/// up to the limit of the energy balance, 1e-3 of the largest energy or 3 % of a speed.
double allowed_error(const Problem& problem, bool implicit, double tolerance) {
  if (!implicit) return (1 + problem.kinks) * 100 * tolerance;
  const double of_speed = 3 * tolerance * problem.stiffest_rad_s * problem.end_s;
  return (1 + problem.kinks) * 3 * std::pow(tolerance, 2. / 3) + std::min(of_speed, 3e-2);
}

std::optional<std::string> judge(Case& drawn) {
  const double kind = drawn.between(0, 1);
  const Problem problem = kind < 0.6 ? stops(drawn) : kind < 0.8 ? rope(drawn) : friction(drawn);
  SolverOptions solver;
  const bool implicit = drawn.chance(0.5);
  solver.integrator = implicit ? Integrator::generalised_alpha : Integrator::dormand_prince;
  solver.formulation = drawn.chance(0.5) ? Formulation::descriptor : Formulation::recursive;
  solver.relative_tolerance = log_between(drawn, implicit ? 1e-7 : 1e-10, 1e-4);
  solver.absolute_tolerance = 1e-3 * solver.relative_tolerance;
  solver.max_step_s = log_between(drawn, 0.01, 1);
  const OutputOptions output{.end_time_s = problem.end_s, .interval_s = problem.end_s / kOutputs};
  std::ostringstream found;
  found << (kind < 0.6   ? "stops, "
            : kind < 0.8 ? "rope, "
                         : "friction, ")
        << (implicit ? "implicit, " : "explicit, ") << "tolerance " << solver.relative_tolerance
        << ", " << problem.kinks << " kinks: ";
  const auto run = [&] { return simulate(problem.model, solver, output); };
  try {
    const History history = run();
    const double error = largest_error(problem, history) / problem.size;
    const double share = energy_error(history.energy);
    const bool is_told = !history.warnings.empty();
    if (share > 1e-3 && !is_told) {
      found << "the balance changes by " << share << " without a word";
      return found.str();
    }
    drawn.was_refused = is_told;
    if (is_told) return {};
    const double allowed = allowed_error(problem, implicit, solver.relative_tolerance);
    if (error > allowed) {
      found << "off by " << error << ", allowed are " << allowed;
      return found.str();
    }
    if (!implicit || error < 1e-7) return {};
    // Order of convergence: with a hundredth of the tolerance the error is 21 times less, half of
    // which is required.
    solver.relative_tolerance /= 100;
    solver.absolute_tolerance /= 100;
    const double finer = largest_error(problem, run()) / problem.size;
    if (finer < error / 2) return {};
    if (finer < allowed_error(problem, implicit, solver.relative_tolerance)) return {};
    found << "off by " << error << ", and by " << finer << " at a hundredth of the tolerance";
    return found.str();
  } catch (const IncompleteRun& error) {
    if (implicit && std::string(error.what()).find("energy balance") != std::string::npos) {
      drawn.was_refused = true;
      return {};
    }
    found << error.what();
    return found.str();
  }
}

}  // namespace

int main(int argc, char** argv) { return flexneck::campaigns::run(argc, argv, judge); }
