// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element_matrices.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

using Matrix81 = Eigen::Matrix<double, 81, 81>;
/// Row 3 i + a, column q: derivative of shape function i by x_a at point q, times the square root
/// of the volume that the point stands for, so that integrals of products are products of matrices.
using Gradients = Eigen::Matrix<double, 81, 27>;

/// Divergence of the 81 nodal fields projected to span {1, x, y, z}, in an orthonormal basis.
Eigen::Matrix<double, 81, 4> projected_divergence(const Gradients& gradients,
                                                  const Eigen::Matrix<double, 3, 27>& positions,
                                                  const Eigen::Matrix<double, 27, 1>& roots) {
  // Centred and scaled for a well-conditioned Gram matrix; the span is the same.
  const Eigen::Vector3d centre = positions.rowwise().mean();
  const double size = (positions.colwise() - centre).cwiseAbs().maxCoeff();
  Eigen::Matrix<double, 27, 4> pressures;
  pressures.col(0) = roots;
  for (int a = 0; a < 3; ++a) {
    pressures.col(a + 1) =
        roots.array() * (positions.row(a).transpose().array() - centre[a]) / size;
  }
  const Eigen::Matrix4d gram = pressures.transpose() * pressures;
  Eigen::Matrix<double, 81, 4> result = gradients * pressures;
  gram.llt().matrixL().transpose().solveInPlace<Eigen::OnTheRight>(result);
  return result;
}

/// Adds mu (delta_ab sum_c H_ic,jc + H_ib,ja), the part 2 mu eps:eps; lower halves.
void add_strain_part(const Matrix81& products, double mu, Matrix81& stiffness) {
  for (int j = 0; j < 27; ++j) {
    for (int i = j; i < 27; ++i) {
      Eigen::Matrix3d h = products.block<3, 3>(3 * i, 3 * j);
      if (i == j) h = Eigen::Matrix3d(h.selfadjointView<Eigen::Lower>());
      auto block = stiffness.block<3, 3>(3 * i, 3 * j);
      block += mu * h.transpose();
      block.diagonal().array() += mu * h.trace();
    }
  }
}

}  // namespace

Hex27Kernel::Hex27Kernel() {
  const mesher::Quadrature rule = mesher::gauss_rule(mesher::ElementKind::hex27, 3);
  const mesher::ShapeTable table = mesher::tabulate(mesher::ElementKind::hex27, rule.points);
  values_ = table.values;
  weights_ = rule.weights;
  for (std::size_t q = 0; q < derivatives_.size(); ++q) {
    for (std::size_t a = 0; a < 3; ++a) {
      derivatives_[q].col(static_cast<Eigen::Index>(a)) =
          table.derivatives[a].col(static_cast<Eigen::Index>(q));
    }
  }
}

void Hex27Kernel::compute(const Hex27Coordinates& nodes_m, const mesher::Material& material,
                          Formulation formulation, ElementMatrices& result) const {
  const double nu = material.poissons_ratio;
  const double mu = material.youngs_modulus_Pa / (2 * (1 + nu));
  const double kappa = material.youngs_modulus_Pa / (3 * (1 - 2 * nu));

  Gradients gradients;
  Eigen::Matrix<double, 27, 1> roots;
  for (int q = 0; q < kPoints; ++q) {
    const auto& derivatives = derivatives_[static_cast<std::size_t>(q)];
    const Eigen::Matrix3d jacobian = nodes_m * derivatives;  // dx_a / dxi_b
    roots[q] = std::sqrt(weights_[q] * jacobian.determinant());
    Eigen::Map<Eigen::Matrix<double, 27, 3, Eigen::RowMajor>>(gradients.col(q).data()) =
        derivatives * (roots[q] * jacobian.inverse());
  }

  // H_ia,jb = int N_i,a N_j,b holds all that the displacements contribute.
  Matrix81 products = Matrix81::Zero();
  products.selfadjointView<Eigen::Lower>().rankUpdate(gradients);
  Matrix81& stiffness = result.stiffness;
  // 2 mu dev:dev = 2 mu eps:eps - 2/3 mu div^2
  if (formulation == Formulation::displacement) {
    stiffness = (kappa - 2 * mu / 3) * products;
  } else {
    stiffness = -2 * mu / 3 * products;
    stiffness.selfadjointView<Eigen::Lower>().rankUpdate(
        projected_divergence(gradients, nodes_m * values_, roots), kappa);
  }
  add_strain_part(products, mu, stiffness);
  stiffness.triangularView<Eigen::StrictlyUpper>() = stiffness.transpose();

  const Eigen::Matrix<double, 27, 27> weighted = values_ * roots.asDiagonal();
  result.mass.setZero();
  result.mass.selfadjointView<Eigen::Lower>().rankUpdate(weighted, material.density_kg_m3);
  result.mass.triangularView<Eigen::StrictlyUpper>() = result.mass.transpose();
}

}  // namespace flexneck::fe_modal
