// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/attached_mass.h"

#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/solve/block_lanczos.h"

namespace flexneck::fe_modal {
namespace {

Settled settled_to(double residual) {
  return [residual](const RitzState& state) { return state.residuals.maxCoeff() < residual; };
}

}  // namespace

AttachedMass::AttachedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& loads,
                           const Matrix6d& rigid_mass)
    : loads_(loads),
      operator_(
          loads.rows(),
          [ranks, mass, rigid_mass, &loads](const Eigen::MatrixXd& fields) {
            Eigen::MatrixXd momenta = block_product(mass, fields);
            multiply(1, loads, rigid_mass * inner_products(ranks, loads, fields), 1, momenta);
            return momenta;
          },
          ranks) {}

EigenPairs lowest_eigenpairs(const AttachedMass& mass, const ShiftInverse& inverse,
                             const Eigen::Ref<const Eigen::MatrixXd>& modes, Eigen::Index count) {
  // Its own method needs no exact solves, which are dear there and never quite exact.
  if (auto own = inverse.iterate(mass.matrix(), count)) return *std::move(own);
  // The error of an eigenvalue is the square of this, over the relative gap to the next.
  constexpr double kResidual = 1e-6;
  Eigen::MatrixXd start(modes.rows(), modes.cols() + mass.loads().cols());
  start << modes, inverse.solve(mass.loads());
  start *= column_products(inverse.ranks(), start, start).cwiseSqrt().cwiseInverse().asDiagonal();
  return block_lanczos(mass.matrix(), inverse, std::move(start), count, settled_to(kResidual));
}

Eigen::MatrixXd converged_vectors(const AttachedMass& mass, const ShiftInverse& inverse,
                                  const EigenPairs& pairs) {
  // The error of a vector is this over the relative gap.
  constexpr double kResidual = 1e-11;
  return block_lanczos(mass.matrix(), inverse, pairs.vectors, pairs.values.size(),
                       settled_to(kResidual))
      .vectors;
}

}  // namespace flexneck::fe_modal
