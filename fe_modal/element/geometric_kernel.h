// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/element/element_kernel.h"

namespace flexneck::fe_modal {

/// Geometric (initial stress) stiffness of one element with n nodes: int N_i,k sigma_kl N_j,l dV in
/// each of the three directions, for the stresses sigma of a displacement field, at the points of
/// the element's stiffness. (Bathe, Finite Element Procedures, section 6.3: K_NL at the undeformed
/// configuration.) Each kernel has its own workspace: use one per thread.
class GeometricKernel {
 public:
  explicit GeometricKernel(const ElementScheme& scheme) : kernel_(scheme) {}

  /// @param nodes_m (3, n) positions of the nodes
  /// @param displacements_m (3n, 1), degree of freedom a n + i is direction a of node i
  /// @param stiffness (3n, 3n), N/m, to which it is added
  void add(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
           const Eigen::MatrixXd& displacements_m, Eigen::MatrixXd& stiffness);

 private:
  ElementKernel kernel_;
  PointFields fields_;
  ElementPoints points_, mass_points_;
  Eigen::MatrixXd gradients_, weighted_;  ///< (n, 3q), dN_i / dx_a and times sigma dV
  Eigen::MatrixXd sum_;                   ///< (n, n)
};

}  // namespace flexneck::fe_modal
