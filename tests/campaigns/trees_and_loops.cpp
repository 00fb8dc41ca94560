// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies on random joints, trees and closed loops, under gravity, springs and dampers: both
// formulations and Simbody agree, and the implicit method comes to the same motion by its order.
#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>

#include "multibody/descriptor/initial_state.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/campaigns/campaign.h"
#include "tests/campaigns/draws.h"
#include "tests/campaigns/mechanism.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using namespace flexneck::campaigns;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double kTolerance = 1e-10;
constexpr double kSame = 1e-6;
/// Initial distance of twin runs, as a fraction of velocities and gravity. Once it has grown by
/// more than kChaos the motion is no longer compared.
constexpr double kApart = 1e-9;
constexpr double kChaos = 1e3;

/// The mechanism as flexneck's model; joints are defined from either end.
Model model_of(const Mechanism& mechanism, Case& drawn) {
  ModelBuilder build;
  build.ground();
  build.model.gravity_m_s2 = mechanism.gravity_m_s2;
  for (std::size_t k = 1; k < mechanism.links.size(); ++k) {
    const Link& link = mechanism.links[k];
    build.body("body " + std::to_string(k),
               RigidBody{link.mass_kg, link.center_m, link.inertia_kg_m2},
               {link.position_m, Quaterniond(link.rotation)}, link.velocity_m_s,
               link.rotation.transpose() * link.angular_velocity_rad_s);
    build.model.bodies.back().velocities_are_open = true;
  }
  const auto marker = [&](std::size_t body, const Vector3d& point, const Matrix3d& axes) {
    const Link& link = mechanism.links[body];
    return build.marker("marker " + std::to_string(build.model.markers.size()), body,
                        link.rotation.transpose() * (point - link.position_m),
                        Quaterniond(link.rotation.transpose() * axes));
  };
  const auto both = [](double stiffness, double damping) {
    Resistance resistance;
    resistance.positive.curve = resistance.negative.curve = LoadCurve::cubic(stiffness);
    resistance.damping = damping;
    return resistance;
  };
  for (const Connection& c : mechanism.connections) {
    const std::string name = "joint " + std::to_string(build.model.joints.size());
    const JointKind& kind = kind_of(c.kind);
    const Matrix3d axes = rotation(drawn);
    const auto inner = marker(c.inner, c.point_m, axes);
    const auto outer = marker(c.outer, c.outer_point_m, c.turn * axes);
    Joint joint{
        name, &kind, inner, outer, axes.transpose() * c.axis, axes.transpose() * c.second_axis};
    joint.lead_m = c.lead_m;
    joint.length_m = (c.outer_point_m - c.point_m).norm();
    if (drawn.chance(0.5)) {
      std::swap(joint.marker_i, joint.marker_j);
      if (kind.axes == JointAxes::two) std::swap(joint.axis, joint.second_axis);
    }
    build.model.joints.push_back(joint);
    if (c.stiffness == 0) continue;
    build.model.forces.add(
        JointResistance{name, build.model.joints.size() - 1,
                        kind.has_distance ? JointCoordinate::distance : JointCoordinate::angle,
                        both(c.stiffness, c.damping)});
  }
  for (const Strut& s : mechanism.struts) {
    const auto i = marker(s.first, s.first_point_m, Matrix3d::Identity());
    const auto j = marker(s.second, s.second_point_m, Matrix3d::Identity());
    const std::string name = "strut " + std::to_string(i);
    if (s.is_bushing) {
      Bushing bushing{name, i, j};
      bushing.stiffness.diagonal() << Vector3d::Constant(s.stiffness),
          Vector3d::Constant(s.turning_stiffness);
      bushing.damping.diagonal().head<3>().setConstant(s.damping);
      build.model.forces.add(bushing);
    } else {
      build.model.forces.add(
          MarkerSpring{name, i, j, s.free_length_m, both(s.stiffness, s.damping)});
    }
  }
  return build.model;
}

Motion motion_of(const History& history) {
  const auto bodies = static_cast<Eigen::Index>(history.state.bodies.size());
  const Eigen::Index outputs = history.time_s.size();
  Motion motion;
  for (std::size_t k = 0; k < motion.size(); ++k)
    motion[k].resize((k == 1 ? 9 : 3) * bodies, outputs);
  for (Eigen::Index k = 0; k < bodies; ++k) {
    const BodyHistory& body = history.state.bodies[static_cast<std::size_t>(k)];
    motion[0].middleRows<3>(3 * k) = body.position_m;
    motion[2].middleRows<3>(3 * k) = body.velocity_m_s;
    for (Eigen::Index t = 0; t < outputs; ++t) {
      const Matrix3d turn = rotation_at(body.rotation, t).toRotationMatrix();
      motion[1].block<9, 1>(9 * k, t) = turn.reshaped();
      motion[3].block<3, 1>(3 * k, t) = turn * body.angular_velocity_rad_s.col(t);
    }
  }
  return motion;
}

/// Largest difference of two motions at each output, as a fraction of the first one's size.
Eigen::VectorXd differences(const Motion& one, const Motion& other) {
  Eigen::VectorXd found = Eigen::VectorXd::Zero(one[0].cols());
  for (std::size_t k = 0; k < one.size(); ++k) {
    Eigen::MatrixXd travel = one[k];
    if (k < 2) travel.colwise() -= Eigen::VectorXd(one[k].col(0));
    const double size = std::max(1e-2, travel.cwiseAbs().maxCoeff());
    found = found.cwiseMax((one[k] - other[k]).cwiseAbs().colwise().maxCoeff().transpose() / size);
  }
  for (Eigen::Index t = 1; t < found.size(); ++t) found[t] = std::max(found[t], found[t - 1]);
  return found;
}

/// Difference of the joints' reactions, as a fraction of the largest.
double difference_of_reactions(const History& one, const History& other, Eigen::Index outputs) {
  std::array<double, 2> off{}, largest{};
  for (std::size_t k = 0; k < one.joints.size(); ++k) {
    for (const auto member : {&JointHistory::force_N, &JointHistory::moment_Nm}) {
      const std::size_t kind = member == &JointHistory::force_N ? 0 : 1;
      const Eigen::Matrix3Xd first = (one.joints[k].*member).leftCols(outputs);
      const Eigen::Matrix3Xd second = (other.joints[k].*member).leftCols(outputs);
      off[kind] = std::max(off[kind], (first - second).cwiseAbs().maxCoeff());
      largest[kind] = std::max({largest[kind], 1e-2, first.cwiseAbs().maxCoeff()});
    }
  }
  return std::max(off[0] / largest[0], off[1] / largest[1]);
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

/// Runs of one model, and the errors found in them.
struct Comparison {
  Comparison(const Mechanism& source, const Model& given)
      : mechanism(source),
        model(given),
        history(run(model, Formulation::descriptor)),
        motion(motion_of(history)) {
    Model twin = model;
    twin.gravity_m_s2 *= 1 + kApart;
    for (Body& body : twin.bodies) {
      body.initial_velocity_m_s *= 1 + kApart;
      body.initial_angular_velocity_rad_s *= 1 + kApart;
    }
    const Motion other = motion_of(run(twin, Formulation::descriptor));
    together = (differences(motion, other).array() < kChaos * kApart).count();
  }

  History run(const Model& of, const SolverOptions& solver) const {
    return simulate(of, solver,
                    {.end_time_s = mechanism.end_s,
                     .interval_s = mechanism.end_s / mechanism.outputs,
                     .states = true});
  }
  History run(const Model& of, Formulation formulation) const {
    return run(of, {.relative_tolerance = kTolerance,
                    .absolute_tolerance = 1e-2 * kTolerance,
                    .formulation = formulation});
  }
  double off(const Motion& other) const { return differences(motion, other)[together - 1]; }

  std::optional<std::string> explicit_finding() const {
    std::ostringstream found;
    if (mechanism.loops() == 0) {
      const History other = run(model, Formulation::recursive);
      const double error = off(motion_of(other));
      const double of_reactions = difference_of_reactions(history, other, together);
      if (error > kSame) found << "the recursive form's motion differs by " << error << "; ";
      if (of_reactions > kSame) found << "its reactions differ by " << of_reactions << "; ";
    }
    if (const auto other = simbody_motion(mechanism)) {
      const double error = off(*other);
      if (error > kSame) found << "Simbody's motion differs by " << error << "; ";
    }
    if (found.str().empty()) return std::nullopt;
    return found.str();
  }

  /// Error of the implicit method; infinite if a guard ends the run, as it should at a coarse
  /// tolerance.
  double implicit_error(double tolerance) const {
    try {
      return off(motion_of(run(model, {.relative_tolerance = tolerance,
                                       .absolute_tolerance = 1e-3 * tolerance,
                                       .integrator = Integrator::generalised_alpha})));
    } catch (const IncompleteRun& error) {
      if (!says(error.what(), "energy balance") && !says(error.what(), "nearly singular")) throw;
      return std::numeric_limits<double>::infinity();
    }
  }

  /// With a 64th of the tolerance the step is a quarter and the error 16 times less, a quarter of
  /// which is required; at the next 64th if the first was too coarse for its order.
  std::optional<std::string> implicit_finding() const {
    double coarse = implicit_error(1e-5);
    std::ostringstream found;
    found << "the implicit method is off by " << coarse;
    for (const double tolerance : {1e-5 / 64, 1e-5 / 4096}) {
      const double fine = implicit_error(tolerance);
      if (fine < coarse / 4 || fine < kSame) return std::nullopt;
      found << ", by " << fine << " at a tolerance of " << tolerance;
      coarse = fine;
    }
    return found.str();
  }

  const Mechanism& mechanism;
  const Model& model;
  History history;
  Motion motion;
  Eigen::Index together;  ///< outputs until twins part
};

/// Messages for a model that the program does not run to its end, or warnings on its results.
bool is_told(const std::string& text) {
  return says(text, "its loads would jump at a rotation of pi") ||
         says(text, "the model has no degree of freedom left") ||
         says(text, "other joints impose the same constraint except for");
}

std::optional<std::string> judge(Case& drawn) {
  Mechanism mechanism = random_mechanism(drawn);
  Model model = model_of(mechanism, drawn);
  const std::vector<Eigen::VectorXd> fitting = fitting_velocities(model);
  for (std::size_t k = 1; k < mechanism.links.size(); ++k) {
    Link& link = mechanism.links[k];
    Body& body = model.bodies[k];
    body.initial_velocity_m_s = link.velocity_m_s = fitting[k].head<3>();
    body.initial_angular_velocity_rad_s = fitting[k].tail<3>();
    link.angular_velocity_rad_s = link.rotation * body.initial_angular_velocity_rad_s;
    body.velocities_are_open = false;
  }
  std::ostringstream who;
  who << mechanism.links.size() - 1 << " bodies, " << mechanism.loops() << " loops"
      << (mechanism.is_planar ? ", planar" : "") << ", " << mechanism.end_s << " s: ";
  try {
    const Comparison comparison(mechanism, model);
    std::optional<std::string> found = comparison.explicit_finding();
    if (!found) found = comparison.implicit_finding();
    for (const std::string& warning : comparison.history.warnings) {
      if (!is_told(warning)) return who.str() + warning;
      drawn.was_refused = true;
    }
    if (found && !drawn.was_refused) return who.str() + *found;
  } catch (const IncompleteRun& error) {
    if (!is_told(error.what())) return who.str() + error.what();
    drawn.was_refused = true;
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) { return flexneck::campaigns::run(argc, argv, judge); }
