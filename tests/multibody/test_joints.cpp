// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "multibody/equations_of_motion.h"
#include "multibody/initial_state.h"
#include "multibody/joints.h"
#include "multibody/projection.h"
#include "multibody/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/point_mass_body.h"

// Every joint between two random deformable bodies, large deformations and velocities. The truth is
// where the two markers are along a motion with given accelerations.

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::first_derivative;
using flexneck::testing::make_point_mass_body;
using flexneck::testing::RandomNumbers;
using flexneck::testing::second_derivative;
using namespace flexneck::multibody;

namespace {

constexpr double kStep = 4e-3;
/// Differences of order 6 against accelerations of the order of 10 m/s^2 and rad/s^2.
constexpr double kTolerance = 1e-7;
const Vector3d kAxis = Vector3d(0.6, 0.0, 0.8);

Matrix3d turned(const Vector3d& theta) {
  const double angle = theta.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix();
}

struct Frame {
  Vector3d p;
  Matrix3d R;
};

Model two_bodies(JointKind kind, bool driven) {
  RandomNumbers random(31);
  Model model;
  if (driven) {
    DrivenBody arm;
    arm.direction = random.vector().normalized();
    arm.initial_velocity_m_s = 1.5;
    arm.acceleration_m_s2 = TimeTable({-1, 1}, {8, 8}, TimeTable::Outside::constant);
    model.bodies.push_back({"i", arm, {random.vector(), random.rotation()}});
  } else {
    model.bodies.push_back(
        {"i", DeformableBody{make_point_mass_body(32, 3).body, VectorXd::Zero(3)}, {}});
  }
  model.bodies.push_back(
      {"j", DeformableBody{make_point_mass_body(33, 2).body, VectorXd::Zero(2)}, {}});
  Marker i{"on i", 0, driven ? "" : "tip", 0.1 * random.vector(), random.rotation()};
  Marker j{"on j", 1, "side", Vector3d::Zero(), random.rotation()};
  model.markers = {i, j};
  model.joints.push_back({"joint", kind, 0, 1, kAxis});
  return model;
}

/// The markers along Q (+) (t V + t^2 / 2 Vdot), by nothing but their definition.
class Path {
 public:
  Path(const Model& model, const System& system, const VectorXd& state, const VectorXd& Vdot)
      : model_(model), system_(system), state_(state), Vdot_(Vdot) {}

  Frame frame(std::size_t index, double t) const {
    const Marker& marker = model_.markers[index];
    const Body& body = model_.bodies[marker.body];
    const Matrix3d R0 = marker.rotation.toRotationMatrix();
    if (const auto* arm = std::get_if<DrivenBody>(&body.kind)) {
      const Matrix3d A = body.initial_pose.rotation.toRotationMatrix();
      const double travel = 1.5 * t + 8 * t * t / 2;
      return {body.initial_pose.position_m + travel * arm->direction + A * marker.position_m,
              A * R0};
    }
    const FreeBody& free = system_.bodies[system_.markers[index].free_body];
    const Index m = free.constants.mode_count();
    const VectorXd V = state_.segment(system_.position_count + free.velocity, 6 + m);
    const VectorXd d = t * V + t * t / 2 * Vdot_.segment(free.velocity, 6 + m);
    const VectorXd Q = state_.segment(free.position, 7 + m);
    const Matrix3d A =
        Quaterniond(Q[3], Q[4], Q[5], Q[6]).toRotationMatrix() * turned(d.segment<3>(3));
    const VectorXd a = Q.tail(m) + d.tail(m);
    const auto& place = std::get<DeformableBody>(body.kind).modes.interface(marker.interface);
    return {Q.head<3>() + d.head<3>() + A * (place.position_m + place.translation * a),
            A * turned(place.rotation * a) * R0};
  }

  Vector3d gap(double t) const { return frame(0, t).p - frame(1, t).p; }
  /// h_j x h_i of a pin.
  Vector3d misalignment(double t) const {
    return (frame(1, t).R * kAxis).cross(frame(0, t).R * kAxis);
  }
  /// log(R_i R_j^T) of a fixed joint.
  Vector3d twist(double t) const { return rotation_log(frame(0, t).R * frame(1, t).R.transpose()); }

 private:
  const Model& model_;
  const System& system_;
  const VectorXd& state_;
  const VectorXd& Vdot_;
};

/// A random state in which i and j coincide as the joint wants, brought onto it in velocity too.
VectorXd joined_state(const Model& model, const System& system, EquationsOfMotion& equations) {
  RandomNumbers random(34);
  VectorXd state = given_state(model, system);
  for (const FreeBody& body : system.bodies) {
    const Index m = body.constants.mode_count();
    state.segment<3>(body.position) = random.vector();
    const Quaterniond q = random.rotation();
    state.segment<4>(body.position + 3) << q.w(), q.x(), q.y(), q.z();
    state.segment(body.position + 7, m) = 0.08 * random.vector(m);
    state.segment(system.position_count + body.velocity, 6 + m) = 1.5 * random.vector(6 + m);
  }
  // Turn and shift body j so that the markers meet; a ball leaves the rotation free, a pin a turn
  // about its axis.
  const VectorXd none = VectorXd::Zero(system.velocity_count);
  const Path path(model, system, state, none);
  const Frame i = path.frame(0, 0);
  const Frame j = path.frame(1, 0);
  Matrix3d freedom = Matrix3d::Identity();
  if (model.joints[0].kind == JointKind::pin) freedom = turned(0.7 * (i.R * kAxis));
  if (model.joints[0].kind == JointKind::ball) freedom = random.rotation().toRotationMatrix();
  const Matrix3d turn = freedom * i.R * j.R.transpose();
  const FreeBody& body = system.bodies.back();
  const Quaterniond q =
      Quaterniond(turn) * Quaterniond(state[body.position + 3], state[body.position + 4],
                                      state[body.position + 5], state[body.position + 6]);
  state.segment<4>(body.position + 3) << q.w(), q.x(), q.y(), q.z();
  const Vector3d gap = path.gap(0);
  state.segment<3>(body.position) += gap;
  Projection(equations).apply(0, state);
  return state;
}

}  // namespace

TEST_CASE("rows of every joint are derivatives of its position residual along a motion") {
  const auto kind = GENERATE(JointKind::ball, JointKind::pin, JointKind::fixed);
  const bool driven = GENERATE(false, true);
  CAPTURE(static_cast<int>(kind), driven);
  const Model model = two_bodies(kind, driven);
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd state = joined_state(model, system, equations);
  const VectorXd V = state.segment(system.position_count, system.velocity_count);
  const VectorXd Vdot = 5 * RandomNumbers(35).vector(system.velocity_count);
  const Path path(model, system, state, Vdot);

  const JointRows& joint = equations.joint(0);
  const auto residual = [&](double t) {
    VectorXd result(joint.rows);
    result.head<3>() = path.gap(t);
    if (kind == JointKind::pin) result.tail<2>() = joint.T.topRows<2>() * path.misalignment(t);
    if (kind == JointKind::fixed) result.tail<3>() = path.twist(t);
    return result;
  };
  // The state keeps the joint, in velocity too: the truth says so, not only the code.
  CHECK(residual(0).norm() < 1e-13);
  CHECK(VectorXd(first_derivative(residual, kStep)).norm() < kTolerance);

  // B Vdot - gamma = d^2 Phi / dt^2 for any accelerations.
  VectorXd rows = -joint.gamma.head(joint.rows);
  const auto add = [&](std::size_t body, const TransposedRows& B) {
    if (body == JointPlace::kNoBody) return;
    rows +=
        B.leftCols(joint.rows).transpose() * Vdot.segment(system.bodies[body].velocity, B.rows());
  };
  add(system.places[0].body_i, joint.B_i);
  add(system.places[0].body_j, joint.B_j);
  const VectorXd expected = second_derivative(residual, kStep);
  CAPTURE(rows.transpose(), expected.transpose());
  CHECK((rows - expected).norm() < kTolerance);
  REQUIRE(expected.norm() > 1);
}

TEST_CASE("velocity rows of every joint are derivatives of its residual off the joint too") {
  const auto kind = GENERATE(JointKind::ball, JointKind::fixed);
  const Model model = two_bodies(kind, false);
  const System system(model);
  EquationsOfMotion equations(system);
  VectorXd state = joined_state(model, system, equations);
  RandomNumbers random(36);
  VectorXd V = random.vector(system.velocity_count);
  state.segment(system.position_count, system.velocity_count) = V;
  equations.set_positions(0, state.head(system.position_count));
  equations.set_velocities(V);
  const VectorXd none = VectorXd::Zero(system.velocity_count);
  const Path path(model, system, state, none);
  const JointRows& joint = equations.joint(0);
  CHECK((joint.velocity_residual.head<3>() -
         first_derivative([&](double t) { return path.gap(t); }, kStep))
            .norm() < kTolerance);
  if (kind == JointKind::fixed)
    CHECK((joint.velocity_residual.tail<3>() -
           first_derivative([&](double t) { return path.twist(t); }, kStep))
              .norm() < kTolerance);
}

TEST_CASE("reactions do no work on motions that keep the joint") {
  const auto kind = GENERATE(JointKind::ball, JointKind::pin, JointKind::fixed);
  const Model model = two_bodies(kind, false);
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd state = joined_state(model, system, equations);
  const RowVector multipliers = RandomNumbers(37).vector(6);
  const JointRows& joint = equations.joint(0);
  const Reaction on_j = reaction(joint, multipliers);
  const NodeKinematics& i = equations.marker(0);
  const NodeKinematics& j = equations.marker(1);
  const double power = on_j.force_N.dot(j.pd - i.pd) + on_j.moment_Nm.dot(j.Om - i.Om);
  CHECK(std::abs(power) < 1e-12);
  // A ball carries no moment, a pin none about its axis.
  if (kind == JointKind::ball) CHECK(on_j.moment_Nm.norm() == 0);
  if (kind == JointKind::pin) CHECK(std::abs(on_j.moment_Nm.dot(j.R * kAxis)) < 1e-15);
  // Section 4.1: the generalised force on body j is -B_j^T lambda.
  const VectorXd on_body = -(joint.B_j * multipliers);
  const VectorXd expected = j.P.transpose() * on_j.force_N + j.W.transpose() * on_j.moment_Nm;
  CHECK((on_body - expected).norm() < 1e-13);
}
