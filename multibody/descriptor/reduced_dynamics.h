// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/SparseCore>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/projection.h"
#include "multibody/equations/kink.h"

namespace flexneck::multibody {

/// Sets M, (velocity_count, velocity_count), from equations whose positions are updated.
void assemble_mass(const EquationsOfMotion& equations, Eigen::SparseMatrix<double>& M);
/// Sets B^T, (velocity_count, constraint_count).
void assemble_rows_transposed(const EquationsOfMotion& equations,
                              Eigen::SparseMatrix<double>& B_transposed);

/// A frame in steady rotation about an axis fixed in the world, along its rate and through a point.
/// By default it is at rest.
struct TurningFrame {
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
};

/// The system in k independent coordinates about a configuration that satisfies the joints: xi
/// displaces along the columns of N, a basis of the null space of B that is orthonormal in M (B N =
/// 0, N^T M N = I), and the joints are closed again afterwards. Velocities and accelerations are
/// relative to a frame in which the prescribed bodies are at rest (equations.md section 10). Since
/// N^T M Vdot = N^T u, in a frame at rest the accelerations of xi at rest are minus the gradient of
/// the potential energy. Force elements are relaxed except in state_matrix().
class ReducedDynamics {
 public:
  /// @param equations  with Drive::held for a frame at rest; must outlive this
  /// @param positions  of the free bodies, satisfying the joints
  /// @param time_s     time of the forces and the prescribed bodies' positions
  ReducedDynamics(EquationsOfMotion& equations, const Eigen::VectorXd& positions, double time_s = 0,
                  TurningFrame frame = {});

  /// The same dynamics at a later time, rotated with the frame until then, and xi with it.
  ReducedDynamics turned(double time_s) const;

  Eigen::Index count() const { return N_.cols(); }
  const Eigen::MatrixXd& basis() const { return N_; }
  /// Largest displacement of a body by xi: of its origin and its deformation in units of the
  /// system's size, or its rotation in rad.
  double extent(const Eigen::VectorXd& xi) const;
  Eigen::VectorXd positions_at(const Eigen::VectorXd& xi);
  /// Accelerations of xi at a displacement xi, at rest.
  Eigen::VectorXd accelerations_at(const Eigen::VectorXd& xi);
  /// Accelerations of xi at a displacement xi with the velocities N rates.
  Eigen::VectorXd accelerations_at(const Eigen::VectorXd& xi, const Eigen::VectorXd& rates);
  /// Returns -d accelerations / d xi and -d accelerations / d xidot by central differences, (k, k).
  Eigen::MatrixXd stiffness();
  Eigen::MatrixXd damping();
  /// System matrix A of y' = A y, y = [xi; xi'; z], (2k + internal), with z the internal variables
  /// of force elements relative to their values at rest; in a frame at rest.
  Eigen::MatrixXd state_matrix();
  /// Load with a kink at the state when stiffness() or state_matrix() was called, see
  /// kink_between(); empty if none.
  const std::string& kink() const { return kink_; }
  /// Velocities of the frame at the positions set last.
  Eigen::VectorXd carried_velocities() const;

 private:
  /// Accelerations of xi and rates of the internal variables, (k + internal), at rest.
  Eigen::VectorXd rates_at(const Eigen::VectorXd& xi);
  RatesAndPieces state_at(const Eigen::VectorXd& xi);
  /// Accelerations of xi at the positions set last.
  /// @param velocities  relative to the frame
  Eigen::VectorXd solve(const Eigen::VectorXd& velocities);

  EquationsOfMotion& equations_;
  Projection projection_;
  Eigen::VectorXd origin_;
  double time_s_;
  TurningFrame frame_;
  Eigen::MatrixXd N_;
  Eigen::MatrixXd MN_;
  std::string kink_;
};

}  // namespace flexneck::multibody
