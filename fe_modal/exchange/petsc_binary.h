// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/exchange/matrix_market.h"

namespace flexneck::fe_modal {

/// PETSc's binary format with 32-bit integers and doubles, big-endian: for a matrix its class,
/// rows, columns, entries, the entries of each row, all columns, all values; for a vector its
/// class, size and values (PETSc manual, MatLoad and VecLoad).
/// @param upper half of a symmetric matrix by rows; both halves are written
void write_petsc_matrix(const std::filesystem::path& path,
                        const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& upper);
MatrixEntries read_petsc_matrix(const std::filesystem::path& path);

void write_petsc_vector(const std::filesystem::path& path, const Eigen::VectorXd& values);
Eigen::VectorXd read_petsc_vector(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
