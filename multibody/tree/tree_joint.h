// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "multibody/model/model.h"
#include "multibody/tree/body_inertia.h"

namespace flexneck::multibody::tree {

/// A joint seen from its inner marker F to its outer one M. Coordinates q and their rates u:
///
/// | joint       | q                        | u                        |
/// |-------------|--------------------------|--------------------------|
/// | fixed       | -                        | -                        |
/// | pin         | angle                    | its rate                 |
/// | slider      | distance                 | its rate                 |
/// | cylindrical | distance, angle          | their rates              |
/// | universal   | angle about F's, M's axis| their rates              |
/// | ball        | quaternion w, x, y, z    | angular velocity, M axes |
/// | floating    | position, quaternion     | velocity in F axes, angular velocity in M axes |
///
/// A floating body hangs on the world by no joint at all.
struct TreeJoint {
  enum class Kind { fixed, pin, slider, cylindrical, universal, ball, floating };

  TreeJoint() = default;  ///< floating
  /// @param joint   not free
  /// @param inner_is_i  F is marker i
  TreeJoint(const Joint& joint, bool inner_is_i);

  Kind kind = Kind::floating;
  Eigen::Vector3d axis_f = Eigen::Vector3d::UnitY();  ///< F axes
  Eigen::Vector3d axis_m = Eigen::Vector3d::UnitY();  ///< M axes
  Eigen::Matrix3d R0 = Eigen::Matrix3d::Identity();   ///< universal: M to F at angles zero
  Eigen::Index velocity_count() const { return kCounts[static_cast<std::size_t>(kind)]; }
  Eigen::Index position_count() const {
    const bool has_quaternion = kind == Kind::ball || kind == Kind::floating;
    return velocity_count() + (has_quaternion ? 1 : 0);
  }

 private:
  /// In the order of Kind.
  static constexpr std::array<Eigen::Index, 7> kCounts = {0, 1, 1, 2, 2, 3, 6};
};

/// Relative motion at given coordinates.
struct JointMotion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< M axes to F axes
  Eigen::Vector3d d = Eigen::Vector3d::Zero();      ///< F to M, F axes
  /// Velocity of M against F is S u, M axes, linear above angular; S has velocity_count() columns.
  Matrix6d S = Matrix6d::Zero();
  Eigen::Vector3d S_dot_u = Eigen::Vector3d::Zero();  ///< angular, M axes
};

void update(const TreeJoint& joint, const Eigen::Ref<const Eigen::VectorXd>& q,
            const Eigen::Ref<const Eigen::VectorXd>& u, JointMotion& motion);
/// q' from u.
void position_rate(const TreeJoint& joint, const Eigen::Ref<const Eigen::VectorXd>& q,
                   const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> rate);
/// q moved by u as a finite displacement.
void retract(const TreeJoint& joint, const Eigen::Ref<const Eigen::VectorXd>& u,
             Eigen::Ref<Eigen::VectorXd> q);
/// The coordinates whose R and d come next to the given ones.
Eigen::VectorXd nearest_coordinates(const TreeJoint& joint, const Eigen::Matrix3d& R,
                                    const Eigen::Vector3d& d);

}  // namespace flexneck::multibody::tree
