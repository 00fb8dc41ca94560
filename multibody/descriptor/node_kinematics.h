// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/descriptor/body_dynamics.h"
#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody {

/// Placement of a marker on its body; psi and mu have a column for each mode of the body.
struct NodeConstants {
  /// @throws InputError if the body has no interface of the marker's name.
  NodeConstants(const Body& body, const Marker& marker);

  Eigen::Vector3d s0;  ///< undeformed position, body axes
  Eigen::Matrix3Xd psi;
  Eigen::Matrix3Xd mu;
  NodeSlopes slopes;   ///< empty without stress stiffening
  Eigen::Matrix3d R0;  ///< marker axes to node axes
  bool moves = false;  ///< it moves with the modes
};

/// A marker's motion, equations.md section 4: pdd = P Vdot + gp, Omd = W Vdot + gr. On a prescribed
/// body P and W are empty and gp, gr are the accelerations themselves.
struct NodeKinematics {
  explicit NodeKinematics(Eigen::Index velocity_count);

  // Terms that depend on the configuration:
  Eigen::Vector3d theta;   ///< nodal rotation vector, body axes
  Eigen::Vector3d s;       ///< position, body axes
  Eigen::Vector3d p;       ///< position, world
  Eigen::Matrix3d R;       ///< marker axes to world
  Eigen::Matrix3Xd P;      ///< (3, 6+m): pd = P V
  Eigen::Matrix3Xd W;      ///< (3, 6+m): Om = W V
  Eigen::Matrix3Xd psi;    ///< (3, m): psi(a)
  Eigen::Matrix3Xd mu;     ///< (3, m): mu(a)
  Eigen::Matrix3Xd Jl_mu;  ///< (3, m)

  // Terms that depend on the velocities, too:
  Eigen::Vector3d pd;  ///< velocity, world
  Eigen::Vector3d Om;  ///< angular velocity, world
  Eigen::Vector3d gp;
  Eigen::Vector3d gr;
};

/// Updates the configuration from x, A and a in `body`.
void update_configuration(const NodeConstants& node, const BodyTerms& body, NodeKinematics& motion);
void update_velocities(const NodeConstants& node, const BodyTerms& body,
                       const Eigen::Ref<const Eigen::VectorXd>& velocity, NodeKinematics& motion);

}  // namespace flexneck::multibody
