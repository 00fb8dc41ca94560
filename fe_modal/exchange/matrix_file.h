// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flexneck::fe_modal {

/// Upper half of a symmetric matrix by rows, the whole diagonal stored.
using UpperMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// Writes a symmetric matrix in the format that the ending says:
/// `.mtx`, Matrix Market: "coordinate real symmetric", lower half, shortest exact decimals;
/// `.petsc`, PETSc binary as MatLoad reads it: both halves, big-endian.
/// @throws InputError for another ending or a file that cannot be written.
void write_matrix(const std::filesystem::path& path, const UpperMatrix& matrix);

/// Reads what write_matrix() writes; Matrix Market "general" too, if it is symmetric to 1e-12 of
/// its largest entry.
/// @throws InputError naming file, and in Matrix Market line, of the first thing that is wrong.
UpperMatrix read_matrix(const std::filesystem::path& path);

/// The same of (n, 3) positions: Matrix Market "array real general", or a PETSc vector of x, y, z
/// by nodes.
void write_positions(const std::filesystem::path& path, const Eigen::Matrix3Xd& positions_m);
Eigen::Matrix3Xd read_positions(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
