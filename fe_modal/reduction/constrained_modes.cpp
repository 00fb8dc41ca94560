// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/constrained_modes.h"

#include <Eigen/Cholesky>

#include "fe_modal/algebra/matrix_product.h"

namespace flexneck::fe_modal {
struct ConstrainedMass::Terms {
  Ranks ranks;
  Eigen::MatrixXd constraints;           ///< C^T, (dofs, n)
  Eigen::MatrixXd responses;             ///< X, (dofs, n)
  Eigen::LLT<Eigen::MatrixXd> products;  ///< factor of C X

  Eigen::MatrixXd project(const Eigen::MatrixXd& fields) const {
    return fields - responses * products.solve(inner_products(ranks, constraints, fields));
  }
  Eigen::MatrixXd project_transposed(const Eigen::MatrixXd& momenta) const {
    return momenta - constraints * products.solve(inner_products(ranks, responses, momenta));
  }
};

namespace {

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

}  // namespace

ConstrainedMass::ConstrainedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& constraints,
                                 const Eigen::MatrixXd& responses)
    : terms_(std::make_shared<const Terms>(
          Terms{ranks, constraints, responses,
                Eigen::LLT<Eigen::MatrixXd>(
                    symmetric_part(inner_products(ranks, constraints, responses)))})),
      operator_(
          constraints.rows(),
          [mass, terms = terms_](const Eigen::MatrixXd& fields) {
            return terms->project_transposed(block_product(mass, terms->project(fields)));
          },
          ranks) {}

Eigen::MatrixXd ConstrainedMass::project(const Eigen::MatrixXd& columns) const {
  return terms_->project(columns);
}

}  // namespace flexneck::fe_modal
