// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/modal_springs.h"
#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody {

/// Constants of a body with m modes, packed for evaluation; a rigid body has none (m = 0). The body
/// frame's origin need not be the centre of mass. Symbols as in equations.md section 2.
struct BodyConstants {
  explicit BodyConstants(const RigidBody& body);
  explicit BodyConstants(const DeformableBody& body);

  Eigen::Index mode_count() const { return S2.cols(); }
  Eigen::Index velocity_count() const { return 6 + mode_count(); }
  /// Root mean square distance of the mass from the origin, m: the length that corresponds to a
  /// radian.
  double radius_m() const;
  bool stiffens() const { return slopes.S2.size() > 0; }

  double mass = 0;
  Eigen::Vector3d S1 = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd S2;
  Eigen::Matrix3d J0 = Eigen::Matrix3d::Zero();
  Eigen::VectorXd G0;  ///< (9m): G0_l column by column
  Eigen::MatrixXd G;   ///< (9m, m): column j holds G_j1 … G_jm
  Eigen::Matrix3Xd N0;
  Eigen::MatrixXd N;  ///< (3m, m): column j holds N_j1 … N_jm
  Eigen::MatrixXd Maa;
  InertiaSlopes slopes;  ///< empty without stress stiffening; their part of G is in G
  ModalSprings springs;
};

/// State-dependent terms of a body's equations. V = [xdot (world); w (body axes); adot].
struct BodyTerms {
  explicit BodyTerms(const BodyConstants& body);

  // Terms that depend on the configuration:
  Eigen::Vector3d x = Eigen::Vector3d::Zero();      ///< origin, world
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();  ///< body axes to world
  Eigen::VectorXd a;                                ///< modal coordinates
  Eigen::Vector3d S;
  Eigen::Matrix3Xd S2;  ///< (3, m): S2(a)
  Eigen::Matrix3d J;
  Eigen::VectorXd G;     ///< (9m): G_l(a)
  Eigen::Matrix3Xd N;    ///< (3, m): N(a)
  Eigen::MatrixXd mass;  ///< (6+m, 6+m), both triangles

  // Terms that depend on the velocities, too:
  Eigen::VectorXd u;           ///< (6+m): right-hand side of eq. (8)
  Eigen::VectorXd work_modes;  ///< scratch
};

/// Section 2: updates all terms that depend on the configuration, from x, A and a in `terms`.
void update_configuration(const BodyConstants& body, BodyTerms& terms);

/// Section 3: sets the inertial, elastic, damping and gravity terms of u; forces are added later.
void update_right_hand_side(const BodyConstants& body, const Eigen::Vector3d& gravity_m_s2,
                            const Eigen::Ref<const Eigen::VectorXd>& velocity, BodyTerms& terms);

double kinetic_energy_J(const BodyTerms& terms, const Eigen::Ref<const Eigen::VectorXd>& velocity);
double gravitational_energy_J(const BodyConstants& body, const Eigen::Vector3d& gravity_m_s2,
                              const BodyTerms& terms);

}  // namespace flexneck::multibody
