// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flexneck::fe_modal {

using MatrixEntry = Eigen::Triplet<double, std::int32_t>;

/// A sparse matrix as listed in a file.
struct MatrixEntries {
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  bool is_symmetric_by_half = false;  ///< only the lower half is listed
  std::vector<MatrixEntry> entries;   ///< indices from 0
};

/// Writes the Matrix Market exchange format (Boisvert, Pozo and Remington, NISTIR 5935, 1996).
/// @param upper half of a symmetric matrix by rows
void write_matrix_market(const std::filesystem::path& path,
                         const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& upper);
MatrixEntries read_matrix_market(const std::filesystem::path& path);

/// Writes a dense matrix, "array real general".
void write_matrix_market_array(const std::filesystem::path& path, const Eigen::MatrixXd& table);
Eigen::MatrixXd read_matrix_market_array(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
