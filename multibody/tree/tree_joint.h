// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/joints/joint.h"
#include "multibody/joints/joint_motion.h"

namespace flexneck::multibody::tree {

/// Motion of a body connected to the world by no joint. Coordinates: position, quaternion; rates:
/// velocity in F axes, angular velocity in M axes.
extern const JointMotionLaw kFloatingMotion;

/// A joint from its inner marker F to its outer one M, with coordinates q and rates u.
struct TreeJoint {
  TreeJoint() = default;  ///< floating
  /// @param joint   of a kind with free motions
  /// @param inner_is_i  true if F is marker i
  TreeJoint(const Joint& joint, bool inner_is_i);

  const JointMotionLaw* law = &kFloatingMotion;
  JointFrame frame;
  Eigen::Index velocity_count() const { return law->rates; }
  Eigen::Index position_count() const { return law->rates + (law->has_quaternion ? 1 : 0); }
  bool is_fixed() const { return law->rates == 0; }
};

inline void update(const TreeJoint& joint, const Coordinates& q, const Coordinates& u,
                   JointMotion& motion) {
  joint.law->update(joint.frame, q, u, motion);
}
/// Computes q' from u.
void position_rate(const TreeJoint& joint, const Coordinates& q, const Coordinates& u,
                   Eigen::Ref<Eigen::VectorXd> rate);
/// Moves q by u as a finite displacement.
void retract(const TreeJoint& joint, const Coordinates& u, Eigen::Ref<Eigen::VectorXd> q);
/// The coordinates whose R and d are nearest to the given ones.
Eigen::VectorXd nearest_coordinates(const TreeJoint& joint, const Eigen::Matrix3d& R,
                                    const Eigen::Vector3d& d);

}  // namespace flexneck::multibody::tree
