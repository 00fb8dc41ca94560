// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/energy_gradient.h"

#include <array>
#include <utility>

#include <Eigen/Cholesky>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/moduli.h"

namespace flexneck::fe_modal {
namespace {

/// State of a field at a point.
struct FieldAtPoint {
  FieldAtPoint(const PointFields& fields, Eigen::Index field, Eigen::Index q, double mu)
      : dilatation(fields.dilatation(field, q)), projected(fields.projected_dilatation(field, q)) {
    for (Eigen::Index a = 0; a < 3; ++a) {
      for (Eigen::Index b = 0; b < 3; ++b) {
        gradient(a, b) = fields.gradients.at(static_cast<std::size_t>(3 * a + b))(field, q);
      }
    }
    stress = mu * (gradient + gradient.transpose());
    stress.diagonal().array() += fields.volumetric_Pa(field, q);
  }

  Eigen::Matrix3d gradient;  ///< (a, b): du_a / dx_b
  Eigen::Matrix3d stress;
  double dilatation;
  double projected;
};

/// Moduli of a material in a scheme, and their derivatives with respect to Poisson's ratio.
struct ModuliOfForms {
  ModuliOfForms(const ElementScheme& scheme, const mesher::Material& material)
      : value(moduli_of(material)),
        by_ratio(moduli_by_poissons_ratio(material)),
        projected(projected_modulus(scheme, value)),
        projected_by_ratio(projected_modulus(scheme, by_ratio)) {}

  Moduli value, by_ratio;
  double projected, projected_by_ratio;  ///< modulus c of the projected dilatation
};

/// Energy densities of two fields at a point.
struct PairAtPoint {
  PairAtPoint(const FieldAtPoint& one, const FieldAtPoint& other)
      : u(one),
        w(other),
        shear(u.gradient.cwiseProduct(w.gradient + w.gradient.transpose()).sum()),
        whole(u.dilatation * w.dilatation),
        projected(u.projected * w.projected) {}

  double energy(const Moduli& moduli, double c) const {
    return moduli.mu * shear + (moduli.lambda - c) * whole + c * projected;
  }
  /// Factor of grad v in the derivative of the stiffness.
  Eigen::Matrix3d tensor(const ModuliOfForms& moduli) const {
    const double c = moduli.projected;
    const double mixed = u.projected * w.dilatation + w.projected * u.dilatation - projected;
    Eigen::Matrix3d result =
        -(u.gradient.transpose() * w.stress + w.gradient.transpose() * u.stress);
    result.diagonal().array() +=
        moduli.value.mu * shear + (moduli.value.lambda - c) * whole + c * mixed;
    return result;
  }

  const FieldAtPoint& u;
  const FieldAtPoint& w;
  double shear;      ///< G_u : (G_w + G_w^T)
  double whole;      ///< div u div w
  double projected;  ///< p_u p_w
};

}  // namespace

EnergyGradient::EnergyGradient(const ElementScheme& scheme, std::vector<EnergyForm> forms)
    : scheme_(scheme), forms_(std::move(forms)), kernel_(scheme) {}

void EnergyGradient::compute(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                             const Eigen::MatrixXd& fields, ElementGradient& result) {
  kernel_.evaluate(nodes_m, material, fields, at_points_);
  kernel_.locate(nodes_m, stiffness_points_, mass_points_);
  if (scheme_.pressures == PressureSpace::linear) find_pressure_gradients();
  const auto count = static_cast<Eigen::Index>(forms_.size());
  result.by_nodes.setZero(3 * count, nodes_m.cols());
  result.by_material.setZero(count, 3);
  add_stiffness(material, result);
  add_mass(material, fields, result);
}

/// Finds the gradients of linear pressures by least squares over the points, which is exact.
void EnergyGradient::find_pressure_gradients() {
  const Eigen::VectorXd& volumes = stiffness_points_.volumes_m3;
  const Eigen::Vector3d centre = stiffness_points_.positions_m * volumes / volumes.sum();
  const Eigen::Matrix3Xd arms = stiffness_points_.positions_m.colwise() - centre;
  const Eigen::Matrix3Xd weighted = arms * volumes.asDiagonal();
  const Eigen::Matrix3d gram = weighted * arms.transpose();
  pressure_gradients_ = gram.ldlt().solve(weighted * at_points_.projected_dilatation.transpose());
}

void EnergyGradient::add_stiffness(const mesher::Material& material, ElementGradient& result) {
  const auto count = static_cast<Eigen::Index>(forms_.size());
  const Eigen::Index points = stiffness_points_.volumes_m3.size();
  const bool is_linear = pressure_gradients_.size() > 0;
  tensors_.resize(3 * count, 3 * points);
  if (is_linear) vectors_.resize(3 * count, points);
  const ModuliOfForms moduli(scheme_, material);
  std::vector<FieldAtPoint> fields;
  for (Eigen::Index q = 0; q < points; ++q) {
    fields.clear();
    for (Eigen::Index k = 0; k < at_points_.dilatation.rows(); ++k) {
      fields.emplace_back(at_points_, k, q, moduli.value.mu);
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      const EnergyForm& form = forms_[static_cast<std::size_t>(k)];
      const FieldAtPoint& u = fields[static_cast<std::size_t>(form.one)];
      const FieldAtPoint& w = fields[static_cast<std::size_t>(form.other)];
      const double volume = stiffness_points_.volumes_m3[q];
      const PairAtPoint pair(u, w);
      const Eigen::Matrix3d tensor = volume * pair.tensor(moduli);
      for (Eigen::Index a = 0; a < 3; ++a) {
        for (Eigen::Index b = 0; b < 3; ++b) {
          tensors_(a * count + k, b * points + q) = tensor(a, b);
        }
      }
      if (is_linear) {
        const Eigen::Vector3d vector =
            pressure_gradients_.col(form.one) * (w.dilatation - w.projected) +
            pressure_gradients_.col(form.other) * (u.dilatation - u.projected);
        for (Eigen::Index a = 0; a < 3; ++a) {
          vectors_(a * count + k, q) = volume * moduli.projected * vector[a];
        }
      }
      result.by_material(k, 0) +=
          volume * pair.energy(moduli.value, moduli.projected) / material.youngs_modulus_Pa;
      result.by_material(k, 1) += volume * pair.energy(moduli.by_ratio, moduli.projected_by_ratio);
    }
  }
  const Eigen::Index n = result.by_nodes.cols();
  for (Eigen::Index b = 0; b < 3; ++b) {
    multiply_by_transpose(1, tensors_.middleCols(b * points, points),
                          stiffness_points_.gradients.middleRows(b * n, n), 1, result.by_nodes);
  }
  if (is_linear) multiply_by_transpose(1, vectors_, stiffness_points_.values, 1, result.by_nodes);
}

void EnergyGradient::add_mass(const mesher::Material& material, const Eigen::MatrixXd& fields,
                              ElementGradient& result) {
  const Eigen::VectorXd& volumes = mass_points_.volumes_m3;
  const Eigen::Index n = result.by_nodes.cols();
  const auto count = static_cast<Eigen::Index>(forms_.size());
  std::array<Eigen::MatrixXd, 3> values;  // (k, q)
  for (std::size_t a = 0; a < 3; ++a) {
    values.at(a) =
        fields.middleRows(static_cast<Eigen::Index>(a) * n, n).transpose() * mass_points_.values;
  }
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, volumes.size());  // -lambda u . w dV
  for (Eigen::Index k = 0; k < count; ++k) {
    const EnergyForm& form = forms_[static_cast<std::size_t>(k)];
    if (form.lambda == 0) continue;
    for (const Eigen::MatrixXd& along : values) {
      products.row(k) += along.row(form.one).cwiseProduct(along.row(form.other));
    }
    products.row(k) *= -form.lambda * volumes.asDiagonal();
  }
  result.by_material.col(2) = products.rowwise().sum();
  result.mass_by_nodes.resize(3, n);
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto gradients = mass_points_.gradients.middleRows(a * n, n);
    multiply_by_transpose(material.density_kg_m3, products, gradients, 1,
                          result.by_nodes.middleRows(a * count, count));
    result.mass_by_nodes.row(a) = material.density_kg_m3 * (gradients * volumes).transpose();
  }
  result.volume_m3 = volumes.sum();
}

}  // namespace flexneck::fe_modal
