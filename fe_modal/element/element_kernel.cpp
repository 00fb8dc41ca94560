// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/element_kernel.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/element/moduli.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {

namespace {

/// Number of pressures of an element.
Eigen::Index pressure_count(PressureSpace space) {
  switch (space) {
    case PressureSpace::none:
      return 0;
    case PressureSpace::constant:
      return 1;
    case PressureSpace::along_axis:
      return 2;
    case PressureSpace::linear:
      return 4;
  }
  return 0;
}

/// Basis of the pressures at the q points of an element's stiffness, (q, p), times the square roots
/// of the points' volumes, orthonormal: sums of products over the points are integrals.
/// @param reference (3, q) reference coordinates of the points
/// @param positions (q, 3) positions of the points; used for linear pressures alone, and
/// overwritten
/// @param pressures must have its size
void find_pressures(PressureSpace space, const Eigen::VectorXd& roots,
                    const Eigen::Matrix3Xd& reference, Eigen::MatrixX3d& positions,
                    Eigen::MatrixXd& pressures) {
  pressures.col(0) = roots;
  if (space == PressureSpace::along_axis) {
    pressures.col(1) = roots.cwiseProduct(reference.row(2).transpose());
  }
  if (space == PressureSpace::linear) {
    // Positions are centred and scaled for a well-conditioned Gram matrix; the span is the same.
    positions.rowwise() -= positions.colwise().mean().eval();
    const double size = positions.cwiseAbs().maxCoeff();
    pressures.rightCols<3>() = (roots / size).asDiagonal() * positions;
  }
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> gram =
      pressures.transpose() * pressures;
  gram.llt().matrixL().transpose().solveInPlace<Eigen::OnTheRight>(pressures);
}

}  // namespace

ElementKernel::Points::Points(mesher::ElementKind kind, int strength) {
  const mesher::Quadrature rule = mesher::gauss_rule(kind, strength);
  const mesher::ShapeTable table = mesher::tabulate(kind, rule.points);
  values = table.values;
  reference = rule.points;
  weights = rule.weights;
  derivatives.resize(values.rows(), 3 * values.cols());
  for (Eigen::Index q = 0; q < values.cols(); ++q) {
    for (std::size_t b = 0; b < 3; ++b) {
      derivatives.col(3 * q + static_cast<Eigen::Index>(b)) = table.derivatives[b].col(q);
    }
  }
  jacobians.resize(3, derivatives.cols());
  roots.resize(values.cols());
}

ElementKernel::ElementKernel(const ElementScheme& scheme)
    : scheme_(scheme),
      points_(scheme.kind, scheme.strength),
      mass_points_(scheme.kind, kMassStrength) {
  const Eigen::Index n = points_.values.rows();
  const Eigen::Index q = points_.values.cols();
  const Eigen::Index p = pressure_count(scheme.pressures);
  gradients_.resize(3 * n, q);
  pressures_.resize(q, p);
  positions_.resize(q, 3);
  divergence_.resize(3 * n, p);
  products_.resize(3 * n, 3 * n);
  weighted_.resize(n, mass_points_.values.cols());
}

void ElementKernel::map(const Eigen::Matrix3Xd& nodes_m, Points& points) {
  points.jacobians.noalias() = nodes_m * points.derivatives;
  find_roots(points);
}

void ElementKernel::find_roots(Points& points) {
  for (Eigen::Index q = 0; q < points.weights.size(); ++q) {
    const double volume = points.weights[q] * points.jacobians.middleCols<3>(3 * q).determinant();
    if (!(volume > 0)) throw ComputationError("the element is inverted at an integration point");
    points.roots[q] = std::sqrt(volume);
  }
}

template <typename Visitor>
void ElementKernel::differentiate(const Points& points, const Visitor& visit) {
  for (Eigen::Index q = 0; q < points.weights.size(); ++q) {
    const Eigen::Matrix3d jacobian = points.jacobians.middleCols<3>(3 * q);
    const Eigen::Matrix3d to_physical = points.roots[q] * jacobian.inverse();
    visit(q, points.derivatives.middleCols<3>(3 * q).lazyProduct(to_physical));
  }
}

void ElementKernel::find_gradients() {
  differentiate(points_, [&](Eigen::Index q, const auto& at_point) {
    Eigen::Map<Eigen::MatrixX3d>(gradients_.col(q).data(), at_point.rows(), 3) = at_point;
  });
}

void ElementKernel::locate(const Eigen::Matrix3Xd& nodes_m, Points& points, ElementPoints& result) {
  map(nodes_m, points);
  result.volumes_m3 = points.roots.cwiseAbs2();
  result.positions_m = nodes_m * points.values;
  result.values = points.values;
  result.gradients.resize(3 * points.values.rows(), points.values.cols());
  differentiate(points, [&](Eigen::Index q, const auto& at_point) {
    Eigen::Map<Eigen::MatrixX3d>(result.gradients.col(q).data(), at_point.rows(), 3) =
        at_point / points.roots[q];
  });
}

void ElementKernel::locate(const Eigen::Matrix3Xd& nodes_m, ElementPoints& of_stiffness,
                           ElementPoints& of_mass) {
  locate(nodes_m, points_, of_stiffness);
  if (scheme_.strength == kMassStrength) {
    of_mass = of_stiffness;
  } else {
    locate(nodes_m, mass_points_, of_mass);
  }
}

void ElementKernel::project_divergence(const Eigen::Matrix3Xd& nodes_m) {
  if (scheme_.pressures == PressureSpace::linear) {
    multiply_transpose(1, points_.values, nodes_m.transpose(), 0, positions_);
  }
  find_pressures(scheme_.pressures, points_.roots, points_.reference, positions_, pressures_);
  multiply(1, gradients_, pressures_, 0, divergence_);
}

/// Adds mu (delta_ab sum_c H_cc + H_ba), the part 2 mu eps:eps, and square H_ab.
void ElementKernel::add_displacement_part(double mu, double square,
                                          Eigen::MatrixXd& stiffness) const {
  const Eigen::Index n = points_.values.rows();
  const auto h = [&](Eigen::Index a, Eigen::Index b) {
    return products_.block(a * n, b * n, n, n);
  };
  for (Eigen::Index a = 0; a < 3; ++a) {
    for (Eigen::Index b = 0; b < 3; ++b) {
      auto block = stiffness.block(a * n, b * n, n, n);
      block += mu * h(b, a) + square * h(a, b);
      if (a == b) block += mu * (h(0, 0) + h(1, 1) + h(2, 2));
    }
  }
}

void ElementKernel::evaluate(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                             const Eigen::MatrixXd& fields, PointFields& result) {
  const Eigen::Index n = points_.values.rows();
  map(nodes_m, points_);
  find_gradients();
  const Eigen::VectorXd to_value = points_.roots.cwiseInverse();
  for (Eigen::Index a = 0; a < 3; ++a) {
    for (Eigen::Index b = 0; b < 3; ++b) {
      result.gradients.at(static_cast<std::size_t>(3 * a + b)) =
          fields.middleRows(a * n, n).transpose() * gradients_.middleRows(b * n, n) *
          to_value.asDiagonal();
    }
  }
  result.volumes_m3 = points_.roots.cwiseAbs2();
  const Moduli moduli = moduli_of(material);
  const double projected = projected_modulus(scheme_, moduli);
  result.dilatation = result.gradients[0] + result.gradients[4] + result.gradients[8];
  result.volumetric_Pa = (moduli.lambda - projected) * result.dilatation;
  if (scheme_.pressures == PressureSpace::none) {
    result.projected_dilatation = result.dilatation;
  } else {
    project_divergence(nodes_m);
    result.projected_dilatation =
        (fields.transpose() * divergence_) * pressures_.transpose() * to_value.asDiagonal();
    result.volumetric_Pa += projected * result.projected_dilatation;
  }
}

void ElementKernel::find_stiffness(const Eigen::Matrix3Xd& nodes_m,
                                   const mesher::Material& material, Eigen::MatrixXd& result) {
  const Moduli moduli = moduli_of(material);

  map(nodes_m, points_);
  find_gradients();
  // Products H_ia,jb = int N_i,a N_j,b contain all contributions of the displacements.
  multiply_by_transpose(1, gradients_, gradients_, 0, products_);
  result.resize(products_.rows(), products_.cols());
  // 2 mu dev:dev + kappa div^2 = 2 mu eps:eps + lambda div^2
  double square = moduli.lambda;
  if (scheme_.pressures != PressureSpace::none) {
    project_divergence(nodes_m);
    const double projected = projected_modulus(scheme_, moduli);
    multiply_by_transpose(projected, divergence_, divergence_, 0, result);
    square -= projected;
  } else {
    result.setZero();
  }
  add_displacement_part(moduli.mu, square, result);
}

void ElementKernel::compute(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                            ElementMatrices& result) {
  find_stiffness(nodes_m, material, result.stiffness);
  const bool shared = scheme_.strength == kMassStrength;
  if (!shared) map(nodes_m, mass_points_);
  const Points& points = shared ? points_ : mass_points_;
  weighted_ = points.values * points.roots.asDiagonal();
  result.mass.resize(weighted_.rows(), weighted_.rows());
  multiply_by_transpose(material.density_kg_m3, weighted_, weighted_, 0, result.mass);
}

}  // namespace flexneck::fe_modal
