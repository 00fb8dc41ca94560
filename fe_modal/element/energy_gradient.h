// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/element/element_kernel.h"

namespace flexneck::fe_modal {

/// Form u^T (K - lambda M) w of two fields whose nodal values are fixed.
struct EnergyForm {
  Eigen::Index one = 0;    ///< index of u among the fields
  Eigen::Index other = 0;  ///< index of w
  double lambda = 0;       ///< 1/s^2
};

/// Derivatives of f forms and of the mass of one element with n nodes.
struct ElementGradient {
  Eigen::MatrixXd by_nodes;  ///< (3f, n): row a f + k has form k by direction a of each node, J/m
  /// (f, 3): derivatives by Young's modulus, J/Pa, Poisson's ratio, J, and density, J/(kg/m^3).
  Eigen::MatrixX3d by_material;
  Eigen::Matrix3Xd mass_by_nodes;  ///< (3, n), kg/m
  double volume_m3 = 0;            ///< derivative of the mass by the density
};

/// Derivatives of an element's energies with respect to the positions of its nodes, in closed form.
/// For each form, with G = grad u, sigma the stress of u and v the velocity of the nodes,
/// interpolated by the element,
///
///   d/dt u^T K w = int [e div v - (G_u^T sigma_w + G_w^T sigma_u) : grad v
///                       + c (b_u (div w - p_w) + b_w (div u - p_u)) . v] dV
///   e = mu (G_u : G_w + G_u : G_w^T) + (lambda - c) div u div w
///       + c (p_u div w + p_w div u - p_u p_w)
///   d/dt u^T M w = int rho u . w div v dV
///
/// where p is the projected dilatation, c the modulus of its energy, and b the gradient of a p that
/// is linear in the positions: p is the maximum of int (2 p div u - p^2) dV over the pressures, so
/// that its coefficients need no derivative. These are the derivatives of the element's own sums
/// over its integration points: they are exact for the matrices that ElementKernel computes,
/// however coarse the mesh. The factors that do not depend on v are found once: the derivative
/// along any motion of the nodes is a product with by_nodes.
///
/// Each object has its own workspace: use one per thread.
class EnergyGradient {
 public:
  EnergyGradient(const ElementScheme& scheme, std::vector<EnergyForm> forms);

  /// @param nodes_m (3, n) positions of the nodes
  /// @param fields (3n, k), degree of freedom a n + i is direction a of node i
  /// @throws ComputationError if the element is inverted at an integration point.
  void compute(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
               const Eigen::MatrixXd& fields, ElementGradient& result);

 private:
  void find_pressure_gradients();
  void add_stiffness(const mesher::Material& material, ElementGradient& result);
  void add_mass(const mesher::Material& material, const Eigen::MatrixXd& fields,
                ElementGradient& result);

  ElementScheme scheme_;
  std::vector<EnergyForm> forms_;
  ElementKernel kernel_;
  PointFields at_points_;
  ElementPoints stiffness_points_, mass_points_;
  Eigen::Matrix3Xd pressure_gradients_;  ///< (3, k), b of each field, 1/m; empty if none is linear
  Eigen::MatrixXd tensors_;              ///< workspace: (3f, 3q), factors of grad v
  Eigen::MatrixXd vectors_;              ///< workspace: (3f, q), factors of v
};

}  // namespace flexneck::fe_modal
