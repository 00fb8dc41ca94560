// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// How the volumetric part of the strain energy is formed.
enum class Formulation {
  mixed_pressure,  ///< Q2/P1: pressure linear within each element, condensed; does not lock
  displacement     ///< from the displacements alone; locks when nu comes near 1/2
};

/// Coordinates of the nodes of one element, in m.
using Hex27Coordinates = Eigen::Matrix<double, 3, 27>;

/// Matrices of one element. Degree of freedom 3 i + a is direction a of node i.
struct ElementMatrices {
  Eigen::Matrix<double, 81, 81> stiffness;  ///< N/m, symmetric, both halves filled
  Eigen::Matrix<double, 27, 27> mass;       ///< consistent, kg, the same in each direction
};

/// Stiffness and consistent mass of the 27-node hexahedron, 3 x 3 x 3 Gauss points, linear
/// isotropic elasticity. The strain energy is mu dev(eps):dev(eps) + kappa/2 p(div u)^2 with the
/// bulk modulus kappa; in the mixed formulation p is the L2 projection to {1, x, y, z} on the
/// element, so that the pressure kappa p(div u) is linear and the stiffness stays symmetric and
/// positive.
///
/// The pressure space is spanned in physical coordinates: the mapped one loses an order on elements
/// that are no parallelepipeds (Boffi and Gastaldi, Numer. Math. 93 (2002)). The split is that into
/// deviator and bulk, not into mu and lambda: on the 26k-DOF neck, set A, the first bending
/// frequency is 0.03 % from the converged one instead of 0.4 %. The mixed formulation serves every
/// material: with it in the aluminium plates as well the same frequency is nearer by 0.02 %.
class Hex27Kernel {
 public:
  Hex27Kernel();

  void compute(const Hex27Coordinates& nodes_m, const mesher::Material& material,
               Formulation formulation, ElementMatrices& result) const;

 private:
  static constexpr int kPoints = 27;
  std::array<Eigen::Matrix<double, 27, 3>, kPoints> derivatives_;  ///< by reference coordinate
  Eigen::Matrix<double, 27, kPoints> values_;
  Eigen::Matrix<double, kPoints, 1> weights_;
};

}  // namespace flexneck::fe_modal
