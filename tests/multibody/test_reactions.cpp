// SPDX-License-Identifier: GPL-3.0-or-later
// Reactions of a moving chain with every kind of joint, by cuts: a joint's reaction is the rate of
// momentum of all bodies beyond it, less gravity.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/formulations.h"
#include "tests/support/tree_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const std::vector<const JointKind*> kKinds = {
    &kUniversalJoint, &kCylindricalJoint, &kPrismaticJoint, &kRevoluteJoint,
    &kSphericalJoint, &kFixedJoint,       &kPlanarJoint,    &kScrewJoint};
constexpr double kOutputInterval_s = 1e-3;
constexpr double kLead_m = 0.2;
/// Tolerance of differences over 1 ms of momenta known to 1e-10.
constexpr double kTolerance = 1e-7;

/// A chain with a body on each joint; every other joint is defined from its outer end.
Model chain() {
  RandomNumbers random(71);
  ModelBuilder build;
  build.model.gravity_m_s2 = {3, -2, -7};
  std::size_t inner = build.marker("ground", build.ground());
  Vector3d place = Vector3d::Zero();
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    const std::string name = std::to_string(k);
    const RigidBody rigid = random_rigid_body(random);
    const auto body = build.body("body " + name, rigid, {place});
    const auto outer = build.marker("outer " + name, body);
    const bool reversed = k % 2 == 1;
    build.joint("joint " + name, kKinds[k], reversed ? outer : inner, reversed ? inner : outer,
                Vector3d(0, 0.6, 0.8));
    build.model.joints.back().lead_m = kLead_m;
    build.marker("cg " + name, body, rigid.center_m);
    const Vector3d next = 0.3 * random.vector();
    inner = build.marker("inner " + name, body, next);
    place += next;
  }
  return build.model;
}

/// Force and moment about a point needed for the motion of all bodies from `first` on.
struct Load {
  Vector3d force, moment;
};

Load needed(const Model& model, const History& history, std::size_t first, Index column,
            const Vector3d& about) {
  Load sum{Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t k = first; k < kKinds.size(); ++k) {
    const auto& body = std::get<RigidBody>(model.bodies[k + 1].kind);
    const MarkerHistory& center = history.marker("cg " + std::to_string(k));
    const auto spin = [&](double t) -> Vector3d {
      const Index at = column + static_cast<Index>(std::lround(t / kOutputInterval_s));
      const Matrix3d R = rotation_at(center.rotation, at).toRotationMatrix();
      return R * body.inertia_kg_m2 * R.transpose() * center.angular_velocity_rad_s.col(at);
    };
    const Vector3d force =
        body.mass_kg * (center.acceleration_m_s2.col(column) - model.gravity_m_s2);
    sum.force += force;
    sum.moment += (Vector3d(center.position_m.col(column)) - about).cross(force) +
                  first_derivative(spin, kOutputInterval_s);
  }
  return sum;
}

}  // namespace

TEST_CASE("every joint of a chain carries what hangs on it") {
  const Model model = chain();
  const History history = simulate(model, solver_of(1e-11, 1e-13),
                                   {.end_time_s = 0.2, .interval_s = kOutputInterval_s});
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    const Joint& joint = model.joints[k];
    const MarkerHistory& marker_i = history.markers[joint.marker_i];
    const MarkerHistory& marker_j = history.markers[joint.marker_j];
    const double sign = k % 2 == 1 ? -1 : 1;
    for (const Index column : {5, 100, 190}) {
      CAPTURE(k, column);
      const Matrix3d R_i = rotation_at(marker_i.rotation, column).toRotationMatrix();
      const Vector3d force = sign * R_i * history.joints[k].force_N.col(column);
      const Vector3d moment = sign * R_i * history.joints[k].moment_Nm.col(column);
      const Load expected = needed(model, history, k, column, marker_j.position_m.col(column));
      CHECK((force - expected.force).norm() < kTolerance * expected.force.norm());
      CHECK((moment - expected.moment).norm() < kTolerance * (1 + expected.moment.norm()));
    }
  }
  // The last body has moved far.
  const Eigen::Matrix3Xd& path = history.marker("cg 5").position_m;
  CHECK((path.col(200) - path.col(0)).norm() > 0.1);
}
