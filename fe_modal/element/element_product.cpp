// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/element_product.h"

#include <cmath>

#include <Eigen/LU>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/pressure_basis.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Three rows become combinations of themselves: row a the sum of factors[a, b] times row b, where
/// `across` and `down` are the steps from b to b + 1 and from a to a + 1.
template <std::size_t bytes>
[[gnu::always_inline]] inline void combine(const double* factors, std::size_t across,
                                           std::size_t down, std::size_t groups,
                                           RowOf<double>* rows) {
  for (std::size_t g = 0; g < groups; ++g) {
    RegisterRow<double, bytes> before[3];
    for (std::size_t b = 0; b < 3; ++b) before[b].load(rows[b * groups + g]);
    for (std::size_t a = 0; a < 3; ++a) {
      RegisterRow<double, bytes> sum{};
      for (std::size_t b = 0; b < 3; ++b) sum.add(factors[a * down + b * across], before[b]);
      sum.store(rows[a * groups + g]);
    }
  }
}

/// The gradients of k fields at a point, in three rows.
struct PointGradients {
  double* first;
  std::size_t row;  ///< numbers in a row
  std::size_t k;

  /// du_a / dx_b, (k)
  [[gnu::always_inline]] double* of(std::size_t a, std::size_t b) const {
    return first + b * row + a * k;
  }
};

/// dilatation = div u.
[[gnu::always_inline]] inline void find_dilatation(const PointGradients& gradients,
                                                   double* dilatation) {
  const double* const xx = gradients.of(0, 0);
  const double* const yy = gradients.of(1, 1);
  const double* const zz = gradients.of(2, 2);
  for (std::size_t c = 0; c < gradients.k; ++c) dilatation[c] = xx[c] + yy[c] + zz[c];
}

/// Gradients become sigma = mu (grad + grad^T) + volumetric I: in one loop, since k is small.
[[gnu::always_inline]] inline void find_stress(double mu, const double* volumetric,
                                               const PointGradients& gradients) {
  // They do not overlap: each is k numbers.
  double* __restrict const xx = gradients.of(0, 0);
  double* __restrict const yy = gradients.of(1, 1);
  double* __restrict const zz = gradients.of(2, 2);
  double* __restrict const xy = gradients.of(0, 1);
  double* __restrict const yx = gradients.of(1, 0);
  double* __restrict const yz = gradients.of(1, 2);
  double* __restrict const zy = gradients.of(2, 1);
  double* __restrict const zx = gradients.of(2, 0);
  double* __restrict const xz = gradients.of(0, 2);
  for (std::size_t c = 0; c < gradients.k; ++c) {
    xx[c] = 2 * mu * xx[c] + volumetric[c];
    yy[c] = 2 * mu * yy[c] + volumetric[c];
    zz[c] = 2 * mu * zz[c] + volumetric[c];
    xy[c] = yx[c] = mu * (xy[c] + yx[c]);
    yz[c] = zy[c] = mu * (yz[c] + zy[c]);
    zx[c] = xz[c] = mu * (zx[c] + xz[c]);
  }
}

/// Calls visit(point, its gradients), compiled for these registers: it must be inline.
template <typename Visitor>
void for_each_point(std::vector<RowOf<double>>& at_points, std::size_t points, std::size_t k,
                    VectorRegisters registers, const Visitor& visit) {
  const std::size_t row = at_points.size() / (3 * points) * kColumnsTogether;
  double* const first = at_points.front().value;
  run_with(
      registers, [&]<std::size_t /*bytes*/>() __attribute__((always_inline)) {
        for (std::size_t p = 0; p < points; ++p) {
          visit(p, PointGradients{first + 3 * p * row, row, k});
        }
      });
}

}  // namespace

ElementProduct::Rule::Rule(mesher::ElementKind kind, int strength, VectorRegisters registers)
    : quadrature(mesher::gauss_rule(kind, strength)),
      tables(kind, quadrature, registers),
      roots(quadrature.weights.size()),
      to_physical(3, 3 * quadrature.weights.size()) {}

ElementProduct::ElementProduct(const ElementScheme& scheme, VectorRegisters registers)
    : scheme_(scheme),
      registers_(registers),
      rule_(scheme.kind, scheme.strength, registers),
      pressures_(rule_.roots.size(), pressure_count(scheme.pressures)),
      point_positions_(rule_.roots.size(), 3) {
  if (scheme.strength != kMassStrength) mass_rule_.emplace(scheme.kind, kMassStrength, registers);
}

void ElementProduct::take_positions(const Eigen::Matrix3Xd& nodes_m) {
  positions_.assign(static_cast<std::size_t>(nodes_m.cols()), {});
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    Eigen::Map<Eigen::Vector3d>(positions_[i].value) = nodes_m.col(static_cast<Eigen::Index>(i));
  }
}

template <typename Visitor>
void ElementProduct::find_roots(Rule& rule, const Visitor& visit) {
  at_points_.resize(3 * rule.point_count());
  rule.tables.to_gradients(positions_.data(), 1, at_points_.data());
  for (Eigen::Index p = 0; p < rule.roots.size(); ++p) {
    Eigen::Matrix3d jacobian;
    for (Eigen::Index b = 0; b < 3; ++b) {
      jacobian.col(b) =
          Eigen::Map<const Eigen::Vector3d>(at_points_[static_cast<std::size_t>(3 * p + b)].value);
    }
    const double volume = rule.quadrature.weights[p] * jacobian.determinant();
    if (!(volume > 0)) throw ComputationError("it is inverted at an integration point");
    rule.roots[p] = std::sqrt(volume);
    visit(p, jacobian);
  }
}

void ElementProduct::map(Rule& rule) {
  find_roots(rule, [&](Eigen::Index p, const Eigen::Matrix3d& jacobian) {
    rule.to_physical.middleCols<3>(3 * p) = rule.roots[p] * jacobian.inverse();
  });
}

void ElementProduct::find_element_pressures() {
  if (scheme_.pressures == PressureSpace::linear) {
    at_points_.resize(rule_.point_count());
    rule_.tables.to_values(positions_.data(), 1, at_points_.data());
    for (Eigen::Index p = 0; p < point_positions_.rows(); ++p) {
      point_positions_.row(p) =
          Eigen::Map<const Eigen::RowVector3d>(at_points_[static_cast<std::size_t>(p)].value);
    }
  }
  find_pressures(scheme_.pressures, rule_.roots, rule_.quadrature.points, point_positions_,
                 pressures_);
}

void ElementProduct::turn_to_stress(const Moduli& moduli, std::size_t field_count) {
  const std::size_t points = rule_.point_count();
  volumetric_.resize(static_cast<Eigen::Index>(field_count), rule_.roots.size());
  const auto of_point = [&](std::size_t p) __attribute__((always_inline)) {
    return volumetric_.data() + p * field_count;
  };
  for_each_point(
      at_points_, points, field_count, registers_,
      [&](std::size_t p, const PointGradients& gradients)
          __attribute__((always_inline)) { find_dilatation(gradients, of_point(p)); });
  if (scheme_.pressures == PressureSpace::none) {
    volumetric_ *= moduli.lambda;
  } else {
    const double projected = projected_modulus(scheme_, moduli);
    coefficients_.resize(volumetric_.rows(), pressures_.cols());
    multiply(1, volumetric_, pressures_, 0, coefficients_);
    multiply_by_transpose(projected, coefficients_, pressures_, moduli.lambda - projected,
                          volumetric_);
  }
  for_each_point(
      at_points_, points, field_count, registers_,
      [&](std::size_t p, const PointGradients& gradients)
          __attribute__((always_inline)) { find_stress(moduli.mu, of_point(p), gradients); });
}

void ElementProduct::apply(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                           const RowOf<double>* fields, std::size_t field_count,
                           RowOf<double>* forces, RowOf<double>* momenta) {
  const std::size_t groups = groups_of(field_count);
  take_positions(nodes_m);
  map(rule_);
  if (scheme_.pressures != PressureSpace::none) find_element_pressures();
  at_points_.resize(3 * rule_.point_count() * groups);
  rule_.tables.to_gradients(fields, groups, at_points_.data());
  const auto combine_all = [&](std::size_t across, std::size_t down) {
    run_with(
        registers_, [&]<std::size_t bytes>() __attribute__((always_inline)) {
          for (Eigen::Index p = 0; p < rule_.roots.size(); ++p) {
            combine<bytes>(rule_.to_physical.col(3 * p).data(), across, down, groups,
                           at_points_.data() + static_cast<std::size_t>(3 * p) * groups);
          }
        });
  };
  // du / dx_b is the sum over a of dxi_a / dx_b du / dxi_a; forces take the transpose of that.
  combine_all(1, 3);
  turn_to_stress(moduli_of(material), field_count);
  combine_all(3, 1);
  rule_.tables.from_gradients(at_points_.data(), groups, forces);

  if (momenta == nullptr) return;
  if (mass_rule_) find_roots(*mass_rule_, [](Eigen::Index /*p*/, const auto& /*jacobian*/) {});
  Rule& mass_rule = mass_rule_ ? *mass_rule_ : rule_;
  masses_kg_ = material.density_kg_m3 * mass_rule.roots.cwiseAbs2();
  mass_rule.tables.multiply_by_mass(masses_kg_, fields, groups, momenta);
}

}  // namespace flexneck::fe_modal
