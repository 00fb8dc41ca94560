// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/matrix_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fe_modal/exchange/matrix_market.h"
#include "fe_modal/exchange/petsc_binary.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kSymmetric = 1e-12;

bool is_binary(const std::filesystem::path& path) {
  if (path.extension() == ".petsc") return true;
  if (path.extension() == ".mtx") return false;
  throw InputError(path.string() +
                   ": expected the ending .mtx (Matrix Market) or .petsc (PETSc binary)");
}

/// Upper half of a symmetric matrix; entries (row, column) and (column, row) of a general matrix
/// must agree and become one.
UpperMatrix upper_half(const std::filesystem::path& path, const MatrixEntries& matrix) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(path.string() + ": " + problem);
  };
  if (matrix.rows != matrix.columns) {
    refuse("expected a square matrix, found " + std::to_string(matrix.rows) + " x " +
           std::to_string(matrix.columns));
  }
  std::vector<MatrixEntry> lower;
  std::vector<MatrixEntry> upper;
  double largest = 0;
  for (const MatrixEntry& entry : matrix.entries) {
    if (!std::isfinite(entry.value())) refuse("an entry is not finite");
    largest = std::max(largest, std::abs(entry.value()));
    if (entry.row() >= entry.col()) lower.emplace_back(entry.col(), entry.row(), entry.value());
    if (entry.row() <= entry.col()) upper.push_back(entry);
  }
  const auto make = [&](std::vector<MatrixEntry>& entries) {
    for (std::int32_t k = 0; k < matrix.rows; ++k) entries.emplace_back(k, k, 0.0);
    UpperMatrix result(matrix.rows, matrix.rows);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  };
  const UpperMatrix result = make(lower);
  if (matrix.is_symmetric_by_half) return result;
  const UpperMatrix other = make(upper);
  const UpperMatrix difference = result - other;
  double asymmetry = 0;
  for (Eigen::Index k = 0; k < difference.nonZeros(); ++k) {
    asymmetry = std::max(asymmetry, std::abs(difference.valuePtr()[k]));
  }
  if (asymmetry > kSymmetric * largest) refuse("expected a symmetric matrix");
  return result;
}

}  // namespace

void write_matrix(const std::filesystem::path& path, const UpperMatrix& matrix) {
  is_binary(path) ? write_petsc_matrix(path, matrix) : write_matrix_market(path, matrix);
}

UpperMatrix read_matrix(const std::filesystem::path& path) {
  note_read(path);
  return upper_half(path, is_binary(path) ? read_petsc_matrix(path) : read_matrix_market(path));
}

void write_positions(const std::filesystem::path& path, const Eigen::Matrix3Xd& positions_m) {
  is_binary(path) ? write_petsc_vector(path, positions_m.reshaped())
                  : write_matrix_market_array(path, positions_m.transpose());
}

namespace {

Eigen::Matrix3Xd positions_in(const std::filesystem::path& path) {
  if (!is_binary(path)) {
    const Eigen::MatrixXd table = read_matrix_market_array(path);
    if (table.cols() != 3) {
      throw InputError(path.string() + ": expected three columns, x, y and z, found " +
                       std::to_string(table.cols()));
    }
    return table.transpose();
  }
  const Eigen::VectorXd values = read_petsc_vector(path);
  if (values.size() % 3 != 0) {
    throw InputError(path.string() + ": expected x, y and z of each node, found " +
                     std::to_string(values.size()) + " numbers");
  }
  return values.reshaped(3, values.size() / 3);
}

}  // namespace

Eigen::Matrix3Xd read_positions(const std::filesystem::path& path) {
  note_read(path);
  Eigen::Matrix3Xd positions_m = positions_in(path);
  for (Eigen::Index n = 0; n < positions_m.cols(); ++n) {
    if (positions_m.col(n).allFinite()) continue;
    throw InputError(path.string() + ": node " + std::to_string(n + 1) +
                     " has a coordinate that is not finite");
  }
  return positions_m;
}

}  // namespace flexneck::fe_modal
