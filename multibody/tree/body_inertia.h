// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/modal_springs.h"
#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody::tree {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix6Xd = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Inertia and springs of a body with m modes (none if it is rigid) in the form that
/// equations.md section 7 needs: derivatives of the moment of inertia by the modal coordinates,
/// symmetric and packed as (xx, yy, zz, xy, xz, yz).
struct BodyInertia {
  explicit BodyInertia(const RigidBody& body);
  explicit BodyInertia(const DeformableBody& body);

  Eigen::Index mode_count() const { return S2.cols(); }

  double mass = 0;
  Eigen::Vector3d S1 = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd S2;
  Vector6d J0 = Vector6d::Zero();
  Matrix6Xd D;        ///< (6, m): dJ/da_l of the undeformed body
  Eigen::MatrixXd E;  ///< (6m, m): column j holds d^2 J / da_j da_l for l = 1 … m
  Eigen::Matrix3Xd N0;
  Eigen::MatrixXd N;  ///< (3m, m): column j holds N_j1 … N_jm
  Eigen::MatrixXd Maa;
  InertiaSlopes slopes;  ///< empty without stress stiffening; their part of E is in E
  ModalSprings springs;

  bool stiffens() const { return slopes.S2.size() > 0; }
};

/// Inertia of a body in its own axes, and its equations' bias at zero accelerations: M (acc, wdot,
/// addot) + bias = load, acc the acceleration of the origin less gravity.
struct InertiaTerms {
  explicit InertiaTerms(const BodyInertia& body);

  Matrix6d M_rr;   ///< rows and columns: translation, rotation
  Matrix6Xd M_ra;  ///< (6, m)
  Eigen::MatrixXd M_aa;
  Vector6d bias_r;
  Eigen::VectorXd bias_a;
};

/// Updates the terms at modal coordinates a, their rates and the angular velocity w (body axes).
void update(const BodyInertia& body, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
            const Eigen::Vector3d& w, InertiaTerms& terms);

/// Updates the terms of the modes for a body whose frame moves without rotation; the moments of
/// loads on the frame are left out.
void update_modes(const BodyInertia& body, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
                  InertiaTerms& terms);

/// Updates the bias of a rigid body whose M is already set.
void update_rigid_bias(const BodyInertia& body, const Eigen::Vector3d& w, InertiaTerms& terms);

/// Kinetic energy for the velocity v of the origin in body axes.
double kinetic_energy_J(const BodyInertia& body, const Eigen::VectorXd& a,
                        const Eigen::VectorXd& a_rate, const Eigen::Vector3d& v,
                        const Eigen::Vector3d& w);

}  // namespace flexneck::multibody::tree
