// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/joints.h"
#include "multibody/descriptor/projection.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/marker_motion.h"
#include "tests/support/point_mass_body.h"

// Every joint between two random deformable bodies, or a prescribed and a deformable one on either
// side, with large deformations and velocities. The reference is the positions of the two markers
// along a motion with given accelerations.

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::first_derivative;
using flexneck::testing::Frame;
using flexneck::testing::make_point_mass_body;
using flexneck::testing::MarkerMotion;
using flexneck::testing::RandomNumbers;
using flexneck::testing::second_derivative;
using flexneck::testing::turned;
using namespace flexneck::multibody;

namespace {

constexpr double kStep = 4e-3;
/// Tolerance of differences of order 6 for rates of the order of 10 m/s and rad/s.
constexpr double kTolerance = 1e-7;
/// Tolerance of second derivatives, relative to their size.
constexpr double kRelativeTolerance = 1e-8;
const Vector3d kAxis(0.6, 0.0, 0.8);
const Vector3d kSecondAxis(0.8, 0.0, -0.6);
/// Rotation and displacement of joints that rotate or slide.
constexpr double kTurn = 0.7;
constexpr double kSlide_m = 0.3;
constexpr double kLead_m = 0.2;
constexpr double kLength_m = 0.5;

enum class Prescribed { none, body_i, body_j };

bool is_sliding(const JointKind* kind) {
  return kind == &kCylindricalJoint || kind == &kPrismaticJoint;
}

/// Position of marker j relative to i, in the axes of i.
Vector3d slide_of(const JointKind* kind) {
  if (is_sliding(kind)) return kSlide_m * kAxis;
  if (kind == &kPlanarJoint) return kSlide_m * kSecondAxis;
  if (kind == &kDistanceJoint) return kLength_m * Vector3d(2, -1, 2) / 3;
  if (kind == &kScrewJoint) return (kTurn / (2 * std::numbers::pi) + 1) * kLead_m * kAxis;
  return Vector3d::Zero();
}

/// Two bodies, one of which may be prescribed. A prescribed one has a marker off its origin.
Model two_bodies(const JointKind* kind, Prescribed which) {
  RandomNumbers random(31);
  Model model;
  const auto add_body = [&](const char* name, unsigned seed, int modes, bool prescribed) {
    if (!prescribed) {
      model.bodies.push_back(
          {name,
           DeformableBody{make_point_mass_body(seed, modes).body, VectorXd::Zero(modes)},
           {}});
      return;
    }
    PrescribedBody arm;
    arm.direction = random.vector().normalized();
    arm.initial_velocity_m_s = 1.5;
    arm.acceleration_m_s2 = TimeTable({-1, 1}, {8, 8}, TimeTable::Outside::constant);
    model.bodies.push_back({name, arm, {random.vector(), random.rotation()}});
  };
  add_body("i", 32, 3, which == Prescribed::body_i);
  add_body("j", 33, 2, which == Prescribed::body_j);
  const Vector3d offset = 0.1 * random.vector();
  model.markers = {
      {"on i", 0, which == Prescribed::body_i ? "" : "tip", offset, random.rotation()},
      {"on j", 1, which == Prescribed::body_j ? "" : "side", offset, random.rotation()}};
  model.joints.push_back({"joint", kind, 0, 1, kAxis, kSecondAxis, kLead_m, kLength_m});
  return model;
}

VectorXd stacked(const VectorXd& first, const VectorXd& second) {
  VectorXd both(first.size() + second.size());
  both << first, second;
  return both;
}

/// The markers along Q (+) (t V + t^2 / 2 Vdot), and the residual of each kind of joint there.
class Path {
 public:
  Path(const Model& model, const System& system, const VectorXd& state, const VectorXd& Vdot)
      : model_(model), system_(system), state_(state), Vdot_(Vdot) {}

  Frame frame(std::size_t index, double t) const {
    const Marker& marker = model_.markers[index];
    const Body& body = model_.bodies[marker.body];
    const Matrix3d R0 = marker.rotation.toRotationMatrix();
    if (const auto* arm = std::get_if<PrescribedBody>(&body.kind)) {
      const Matrix3d A = body.initial_pose.rotation.toRotationMatrix();
      const double travel = 1.5 * t + 8 * t * t / 2;
      return {body.initial_pose.position_m + travel * arm->direction + A * marker.position_m,
              A * R0};
    }
    const FreeBody& free = system_.bodies[system_.markers[index].free_body];
    const Index m = free.constants.mode_count();
    const VectorXd Q = state_.segment(free.position, 7 + m);
    const MarkerMotion motion{std::get<DeformableBody>(body.kind).modes.interface(marker.interface),
                              R0,
                              Q.head<3>(),
                              Quaterniond(Q[3], Q[4], Q[5], Q[6]).toRotationMatrix(),
                              Q.tail(m),
                              state_.segment(system_.position_count + free.velocity, 6 + m),
                              Vdot_.segment(free.velocity, 6 + m)};
    return motion.frame(t);
  }

  /// @param D  constrained directions of the positions at t = 0; a slider's rotate with marker i
  /// @param T  constrained directions of the orientations of a revolute or cylindrical joint at t =
  /// 0
  VectorXd residual(const JointKind* kind, double t, const Matrix3d& D, const Matrix3d& T) const {
    const Frame i = frame(0, t);
    const Frame j = frame(1, t);
    const Vector3d gap = i.p - j.p;
    const Vector3d across = T * (j.R * kAxis).cross(i.R * kAxis);
    const Vector3d twist = rotation_log(i.R * j.R.transpose());
    const Vector3d sliding = D * frame(0, 0).R * i.R.transpose() * gap;
    if (kind == &kSphericalJoint) return gap;
    if (kind == &kRevoluteJoint) return stacked(gap, across.head<2>());
    if (kind == &kFixedJoint) return stacked(gap, twist);
    if (kind == &kUniversalJoint)
      return stacked(gap, VectorXd::Constant(1, (i.R * kAxis).dot(j.R * kSecondAxis)));
    if (kind == &kCylindricalJoint) return stacked(sliding.head<2>(), across.head<2>());
    if (kind == &kPrismaticJoint) return stacked(sliding.head<2>(), twist);
    if (kind == &kPlanarJoint) return stacked(sliding.head<1>(), across.head<2>());
    if (kind == &kDistanceJoint) return VectorXd::Constant(1, gap.norm() - kLength_m);
    if (kind == &kScrewJoint) {
      const Vector3d turned = i.R.transpose() * j.R * kSecondAxis;
      const double angle =
          std::atan2(kAxis.cross(kSecondAxis).dot(turned), kSecondAxis.dot(turned));
      const double advance = kAxis.dot(i.R.transpose() * -gap);
      const double turns = angle / (2 * std::numbers::pi) + 1;
      return stacked(stacked(sliding.head<2>(), across.head<2>()),
                     VectorXd::Constant(1, kLead_m * turns - advance));
    }
    return {};
  }

 private:
  const Model& model_;
  const System& system_;
  const VectorXd& state_;
  const VectorXd& Vdot_;
};

/// An orientation that the joint permits marker j for a given one of i.
Matrix3d joined_orientation(const JointKind* kind, const Matrix3d& R_i) {
  if (kind->rotation == RotationConstraint::none)
    return RandomNumbers(38).rotation().toRotationMatrix();
  if (kind->rotation == RotationConstraint::common_axis) return R_i * turned(kTurn * kAxis);
  if (kind == &kUniversalJoint)
    return R_i * turned(kTurn * kAxis) * turned(0.5 * kTurn * kSecondAxis);
  return R_i;
}

/// A random state in which i and j satisfy the joint, corrected to satisfy it in velocity too.
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
  // Rotate and shift the last free body so that the markers coincide.
  const VectorXd none = VectorXd::Zero(system.velocity_count);
  const Path path(model, system, state, none);
  const JointKind* const kind = model.joints[0].kind;
  const Frame i = path.frame(0, 0);
  const Frame j = path.frame(1, 0);
  const FreeBody& body = system.bodies.back();
  const bool moves_j = body.index == 1;
  // Condition: R_j = R_i F.
  const Matrix3d F = i.R.transpose() * joined_orientation(kind, i.R);
  const Matrix3d turn =
      moves_j ? i.R * F * j.R.transpose() : Matrix3d(j.R * F.transpose() * i.R.transpose());
  const Quaterniond q =
      Quaterniond(turn) * Quaterniond(state[body.position + 3], state[body.position + 4],
                                      state[body.position + 5], state[body.position + 6]);
  state.segment<4>(body.position + 3) << q.w(), q.x(), q.y(), q.z();
  const Vector3d slide = path.frame(0, 0).R * slide_of(kind);
  const Vector3d gap = path.frame(0, 0).p + slide - path.frame(1, 0).p;
  state.segment<3>(body.position) += moves_j ? gap : Vector3d(-gap);
  Projection(equations).apply(0, state);
  return state;
}

const JointKind* any_joint() {
  return GENERATE(&kSphericalJoint, &kRevoluteJoint, &kFixedJoint, &kUniversalJoint,
                  &kCylindricalJoint, &kPrismaticJoint, &kPlanarJoint, &kScrewJoint,
                  &kDistanceJoint);
}

}  // namespace

TEST_CASE("rows of every joint are derivatives of its position residual along a motion") {
  const JointKind* const kind = any_joint();
  const Prescribed prescribed = GENERATE(Prescribed::none, Prescribed::body_i, Prescribed::body_j);
  CAPTURE(kind->name, static_cast<int>(prescribed));
  const Model model = two_bodies(kind, prescribed);
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd state = joined_state(model, system, equations);
  const VectorXd Vdot = 5 * RandomNumbers(35).vector(system.velocity_count);
  const Path path(model, system, state, Vdot);

  const JointRows& joint = equations.joint(0);
  const auto residual = [&](double t) { return path.residual(kind, t, joint.D, joint.T); };
  REQUIRE(residual(0).size() == joint.rows);
  // The state satisfies the joint, in velocity too, by the reference and not only by the code.
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
  CHECK((rows - expected).norm() < kRelativeTolerance * expected.norm());
  REQUIRE(expected.norm() > 1);
}

TEST_CASE("velocity rows of every joint are derivatives of its residual off the joint too") {
  // Kinds with a common axis are left out: their T is redefined at the configuration, so Phi is
  // valid only on the joint.
  const JointKind* const kind = GENERATE(&kSphericalJoint, &kFixedJoint, &kUniversalJoint);
  const Model model = two_bodies(kind, Prescribed::none);
  const System system(model);
  EquationsOfMotion equations(system);
  VectorXd state = joined_state(model, system, equations);
  const VectorXd V = RandomNumbers(36).vector(system.velocity_count);
  state.segment(system.position_count, system.velocity_count) = V;
  equations.set_positions(0, state.head(system.position_count));
  equations.set_velocities(V);
  const VectorXd none = VectorXd::Zero(system.velocity_count);
  const Path path(model, system, state, none);
  const JointRows& joint = equations.joint(0);
  const auto residual = [&](double t) { return path.residual(kind, t, joint.D, joint.T); };
  const VectorXd expected = first_derivative(residual, kStep);
  CHECK((joint.velocity_residual.head(joint.rows) - expected).norm() < kTolerance);
  REQUIRE(expected.norm() > 0.1);
}

TEST_CASE("reactions do no work on motions that keep the joint") {
  const JointKind* const kind = any_joint();
  CAPTURE(kind->name);
  const Model model = two_bodies(kind, Prescribed::none);
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd state = joined_state(model, system, equations);
  const JointRows& joint = equations.joint(0);
  RowVector multipliers = RowVector::Zero();
  multipliers.head(joint.rows) = RandomNumbers(37).vector(joint.rows);
  const Reaction on_j = reaction(joint, multipliers);
  const NodeKinematics& i = equations.marker(0);
  const NodeKinematics& j = equations.marker(1);
  // The force acts at the position of marker j; body i moves there with its marker's rotation.
  const Vector3d arm = j.p - i.p;
  const double power =
      on_j.force_N.dot(j.pd - i.pd - i.Om.cross(arm)) + on_j.moment_Nm.dot(j.Om - i.Om);
  CHECK(std::abs(power) < 1e-12);
  // A joint carries no load in its free directions.
  const Vector3d h = i.R * kAxis;
  if (kind == &kSphericalJoint) CHECK(on_j.moment_Nm.norm() == 0);
  if (kind->has_angle && !kind->advances) CHECK(std::abs(on_j.moment_Nm.dot(h)) < 1e-14);
  if (is_sliding(kind)) CHECK(std::abs(on_j.force_N.dot(h)) < 1e-14);
  if (kind == &kDistanceJoint) CHECK(on_j.moment_Nm.norm() == 0);
  if (kind == &kPlanarJoint) CHECK(on_j.force_N.cross(h).norm() < 1e-14);
  if (kind == &kUniversalJoint) {
    CHECK(std::abs(on_j.moment_Nm.dot(h)) < 1e-14);
    CHECK(std::abs(on_j.moment_Nm.dot(j.R * kSecondAxis)) < 1e-14);
  }
  // Section 4.1: the generalised forces are -B^T lambda.
  const VectorXd force_on_j = j.P.transpose() * on_j.force_N + j.W.transpose() * on_j.moment_Nm;
  CHECK((-(joint.B_j * multipliers) - force_on_j).norm() < 1e-13);
  const VectorXd force_on_i = -i.P.transpose() * on_j.force_N -
                              i.W.transpose() * (on_j.moment_Nm + arm.cross(on_j.force_N));
  CHECK((-(joint.B_i * multipliers) - force_on_i).norm() < 1e-13);
}

TEST_CASE("a free joint holds nothing") {
  const Model model = two_bodies(&kFreeJoint, Prescribed::none);
  const System system(model);
  EquationsOfMotion equations(system);
  VectorXd state = given_state(model, system);
  VectorXd rate = VectorXd::Zero(state.size());
  equations.evaluate(0, state, rate);
  CHECK(system.constraint_count == 0);
  CHECK(rate.allFinite());
  CHECK(equations.joint_reaction(0).force_N.norm() == 0);
  CHECK(equations.joint_reaction(0).moment_Nm.norm() == 0);
}
