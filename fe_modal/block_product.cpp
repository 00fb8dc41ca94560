// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/block_product.h"

namespace flexneck::fe_modal {

VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column) {
  return vector_on({columns.col(column).data(), static_cast<std::size_t>(columns.rows())});
}

Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VecHandle in = column_vector(columns, k);
    const VecHandle out = column_vector(result, k);
    require(MatMult(matrix, in.get(), out.get()), "multiplying with a matrix");
  }
  return result;
}

}  // namespace flexneck::fe_modal
