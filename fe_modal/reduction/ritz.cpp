// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/ritz.h"

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/reduction/static_response.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// Number of orthogonalisation passes: the second removes the rounding that the first has
/// magnified.
constexpr int kPasses = 2;

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

}  // namespace

EigenPairs ritz_pairs(const BodyOperators& body, const Eigen::MatrixXd& modes,
                      Eigen::MatrixXd shapes) {
  EigenPairs pairs{Eigen::VectorXd(shapes.cols()), std::move(shapes)};
  if (pairs.values.size() == 0) return pairs;
  const Eigen::MatrixXd momenta = modes.cols() > 0 ? body.mass(modes) : modes;
  for (int pass = 0; pass < kPasses; ++pass) {
    remove_modes(body.ranks, modes, momenta, pairs.vectors);
    Eigen::MatrixXd mass = inner_products(body.ranks, pairs.vectors, body.mass(pairs.vectors));
    Eigen::MatrixXd stiffness =
        inner_products(body.ranks, pairs.vectors, body.stiffness(pairs.vectors));
    // Shapes are scaled to unit mass, so that the small problem is as well conditioned as possible.
    const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
    mass = scale.asDiagonal() * symmetric_part(mass) * scale.asDiagonal();
    stiffness = scale.asDiagonal() * symmetric_part(stiffness) * scale.asDiagonal();
    const SymmetricPairs found = symmetric_pairs(stiffness, mass);
    pairs.values = found.values;
    pairs.vectors *= scale.asDiagonal() * found.vectors;
  }
  return pairs;
}

}  // namespace flexneck::fe_modal
