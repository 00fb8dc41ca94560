// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/massless_rotation.h"

#include <algorithm>
#include <vector>

#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/symmetric_pairs.h"
#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/initial_state.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Moment of inertia up to which it counts as zero, as a fraction of m l^2 (synthetic: the rounding
/// of a tensor that was rotated and moved some hundred times).
constexpr double kNoInertia = 1e-13;
/// Fraction of l: a joint that a unit rotation moves by less does not constrain it.
constexpr double kHeld = 1e-6;

/// Returns whether all moments count whatever l is: no body extends further than twice the size.
bool is_massive(const RigidBody& body, const Vector3d& moments, double size_m) {
  return moments[0] > kNoInertia * body.mass_kg * 4 * size_m * size_m;
}

/// The length l of the header.
double length_m(const Model& model, std::size_t body, double size_m) {
  const Vector3d& center = std::get<RigidBody>(model.bodies[body].kind).center_m;
  double length = center.norm();
  for (const Joint& joint : model.joints)
    for (const std::size_t k : {joint.marker_i, joint.marker_j})
      if (model.markers[k].body == body)
        length = std::max(length, (model.markers[k].position_m - center).norm());
  return length > 0 ? length : size_m;
}

/// A rotation of a free body about an axis through its centre of mass without inertia.
struct MasslessRotation {
  std::size_t body;  ///< index among the system's
  Vector3d axis;     ///< body axes
  double length_m;
};

std::vector<MasslessRotation> massless_rotations(const System& system) {
  std::vector<MasslessRotation> found;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const std::size_t index = system.bodies[b].index;
    const auto* rigid = std::get_if<RigidBody>(&system.model.bodies[index].kind);
    if (rigid == nullptr) continue;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> moments(rigid->inertia_kg_m2);
    if (is_massive(*rigid, moments.eigenvalues(), system.size_m)) continue;
    const double length = length_m(system.model, index, system.size_m);
    for (Index k = 0; k < 3; ++k)
      if (moments.eigenvalues()[k] <= kNoInertia * rigid->mass_kg * length * length)
        found.push_back({b, moments.eigenvectors().col(k), length});
  }
  return found;
}

/// Motion of the joints' rows by a unit rotation, distances in units of l.
VectorXd moved_rows(const EquationsOfMotion& equations, const MasslessRotation& rotation) {
  const System& system = equations.system();
  const std::size_t index = system.bodies[rotation.body].index;
  const Vector3d& center = std::get<RigidBody>(system.model.bodies[index].kind).center_m;
  VectorXd velocity(6);
  velocity << equations.body(rotation.body).A * center.cross(rotation.axis), rotation.axis;
  VectorXd moved = VectorXd::Zero(system.constraint_count);
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    const auto add = [&](std::size_t body, const TransposedRows& rows) {
      if (body != rotation.body) return;
      RowVector of_joint = rows.transpose() * velocity;
      for (Index row = 0; row < joint.rows; ++row)
        if (is_length(joint, row)) of_joint[row] /= rotation.length_m;
      moved.segment(equations.solver().joint_offset(k), joint.rows) += of_joint.head(joint.rows);
    };
    add(system.places[k].body_i, joint.B_i);
    add(system.places[k].body_j, joint.B_j);
  }
  return moved;
}

[[noreturn]] void refuse(const System& system, const std::vector<MasslessRotation>& rotations,
                         const VectorXd& shares) {
  Index largest = 0;
  shares.cwiseAbs().maxCoeff(&largest);
  const std::size_t body = rotations[static_cast<std::size_t>(largest)].body;
  Vector3d axis = Vector3d::Zero();
  for (std::size_t k = 0; k < rotations.size(); ++k)
    if (rotations[k].body == body) axis += shares[static_cast<Index>(k)] * rotations[k].axis;
  axis.normalize();
  // Rounding and the sign of the axis are not shown.
  Index main = 0;
  axis.cwiseAbs().maxCoeff(&main);
  if (axis[main] < 0) axis = -axis;
  axis = (axis.array().abs() < 1e-9).select(0, axis);
  throw InputError(
      "body '" + system.bodies[body].name + "' has no moment of inertia about the axis (" +
      rounded_texts({axis.data(), 3}) +
      ") of its frame, through its centre of mass, and no joint constrains that rotation, so that "
      "it is not determined; give it a moment of inertia, or constrain the rotation");
}

}  // namespace

Matrix3d raised_inertia(const Model& model, std::size_t body, double size_m) {
  const RigidBody& rigid = std::get<RigidBody>(model.bodies[body].kind);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> moments(rigid.inertia_kg_m2);
  if (is_massive(rigid, moments.eigenvalues(), size_m)) return rigid.inertia_kg_m2;
  const double length = length_m(model, body, size_m);
  const double least = kNoInertia * rigid.mass_kg * length * length;
  const Vector3d missing = (least - moments.eigenvalues().array()).max(0);
  return rigid.inertia_kg_m2 +
         moments.eigenvectors() * missing.asDiagonal() * moments.eigenvectors().transpose();
}

void check_massless_rotations(const Model& model) {
  const System system(model);
  const std::vector<MasslessRotation> rotations = massless_rotations(system);
  if (rotations.empty()) return;
  EquationsOfMotion equations(system, Drive::held);
  equations.update_positions(0, given_state(model, system).head(system.position_count));
  const auto count = static_cast<Index>(rotations.size());
  MatrixXd moved(system.constraint_count, count);
  for (Index k = 0; k < count; ++k)
    moved.col(k) = moved_rows(equations, rotations[static_cast<std::size_t>(k)]);
  // Velocities without kinetic energy must move a joint, otherwise M and B leave them undetermined.
  const auto [values, vectors] = symmetric_pairs(moved.transpose() * moved);
  if (values[0] <= kHeld * kHeld) refuse(system, rotations, vectors.col(0));
}

}  // namespace flexneck::multibody
