// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// How the volumetric part of the strain energy is formed.
enum class Formulation {
  displacement,   ///< from the displacements alone; locks when nu comes near 1/2
  mixed_pressure  ///< Q2/P1: pressure linear within each element, condensed; does not lock
};

/// Mixed for nearly incompressible material (nu > 0.45), displacement otherwise.
Formulation formulation_for(const mesher::Material& material);

/// Coordinates of the nodes of one element, in m.
using Hex27Coordinates = Eigen::Matrix<double, 3, 27>;

/// Matrices of one element. Degree of freedom 3 i + a is direction a of node i.
struct ElementMatrices {
  Eigen::Matrix<double, 81, 81> stiffness;  ///< N/m, symmetric, both halves filled
  Eigen::Matrix<double, 27, 27> mass;       ///< consistent, kg, the same in each direction
};

/// Stiffness and consistent mass of the 27-node hexahedron, 3 x 3 x 3 Gauss points. Linear
/// isotropic elasticity, sigma = 2 mu eps + lambda tr(eps) I; in the mixed formulation tr(eps) of
/// the lambda term is its L2 projection to {1, x, y, z} on the element. That space is spanned in
/// physical coordinates, since the mapped one loses an order on elements that are no
/// parallelepipeds (Boffi and Gastaldi, Numer. Math. 93 (2002)).
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
