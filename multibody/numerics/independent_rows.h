// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace flexneck::multibody {

/// Fraction of a constraint row: the row depends on others if less than this is independent of
/// them. Rounded input may rotate it by about as much (joint_check.h).
inline constexpr double kDependent = 3e-6;

/// The fraction of each constraint row that is independent of the independent rows before it; zero
/// for rows that depend on these, at most kDependent being independent. It depends on geometry
/// alone, not on masses. Uses a sparse QR factorisation: work proportional to the number of rows
/// where joints form chains, rings and trees.
/// @param rows_transposed  B^T with each velocity in metres, one column for each row of B
Eigen::VectorXd independent_shares(const Eigen::SparseMatrix<double>& rows_transposed);

/// The multipliers without effect on the motion, B^T lambda = 0: a column for each dependent row,
/// whose own multiplier is one.
Eigen::MatrixXd free_multipliers(const Eigen::SparseMatrix<double>& rows_transposed,
                                 const std::vector<bool>& dependent);

}  // namespace flexneck::multibody
