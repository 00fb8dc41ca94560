// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/identity.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

std::string number_text(double value) { return rounded_text(value, 3); }

}  // namespace

std::string entry_text(Eigen::Index row, Eigen::Index column) {
  return "[" + std::to_string(row) + ", " + std::to_string(column) + "]";
}

void require_identity(const std::string& dataset, const std::string& identity, double difference,
                      double allowed) {
  if (std::abs(difference) <= allowed) return;
  throw InputError(dataset + ": expected that " + identity + ", but the difference is " +
                   number_text(std::abs(difference)) + ", more than the rounding error of " +
                   number_text(allowed));
}

void require_symmetric(const std::string& dataset, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                       double allowed) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      require_identity(dataset, entry_text(i, j) + " equals " + entry_text(j, i),
                       matrix(i, j) - matrix(j, i), allowed);
    }
  }
}

void require_positive(const std::string& dataset, const std::string& what,
                      const Eigen::MatrixXd& matrix, double allowed) {
  const auto identity = Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix + allowed * identity);
  if (factor.info() == Eigen::Success) return;
  throw InputError(
      dataset + ": expected that " + what +
      " is positive semidefinite, but its lowest eigenvalue, scaled to a unit diagonal, is " +
      number_text(symmetric_eigenvalues(matrix)[0]) + ", below the rounding error of " +
      number_text(-allowed));
}

Eigen::VectorXd unit_scales(const std::string& dataset, const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd scales = Eigen::VectorXd::Zero(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (matrix.row(i).isZero(0)) continue;
    if (!(matrix(i, i) > 0)) {
      throw InputError(dataset + ": expected that " + entry_text(i, i) + " is positive, found " +
                       number_text(matrix(i, i)));
    }
    scales[i] = 1 / std::sqrt(matrix(i, i));
  }
  return scales;
}

}  // namespace flexneck::fe_modal
