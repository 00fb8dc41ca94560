// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flexneck::fe_modal {

/// Upper half of a symmetric matrix by rows, the whole diagonal stored.
using UpperMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// Writes a symmetric matrix in the format of the file's ending:
/// `.mtx`, Matrix Market: "coordinate real symmetric", lower half, shortest exact decimals;
/// `.petsc`, PETSc binary as MatLoad reads it: both halves, big-endian.
/// @throws InputError for another ending or a file that cannot be written.
void write_matrix(const std::filesystem::path& path, const UpperMatrix& matrix);

/// Reads files of write_matrix(), and Matrix Market "general" if it is symmetric to 1e-12 of its
/// largest entry.
/// @throws InputError naming the file, and for Matrix Market the line, of the first error.
UpperMatrix read_matrix(const std::filesystem::path& path);

/// Writes and reads positions, (n, 3), in these formats: Matrix Market "array real general", or a
/// PETSc vector of x, y, z by nodes.
void write_positions(const std::filesystem::path& path, const Eigen::Matrix3Xd& positions_m);
Eigen::Matrix3Xd read_positions(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
