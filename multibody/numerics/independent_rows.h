// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace flexneck::multibody {

/// A constraint row depends on others if less than this share of it is left across them: about as
/// much as rounded input may turn it (joint_check.h).
inline constexpr double kDependent = 3e-6;

/// The share of each constraint row that is left across the independent rows before it; zero of
/// those that depend on these, of which no more than kDependent is left. Geometry alone decides;
/// masses play no part. By a sparse QR factorisation: work in proportion to the number of rows
/// where joints make chains, rings and trees.
/// @param rows_transposed  B^T with each velocity in metres, one column a row of B
Eigen::VectorXd independent_shares(const Eigen::SparseMatrix<double>& rows_transposed);

/// The multipliers that move nothing, B^T lambda = 0: a column for each dependent row, where its
/// multiplier is one.
Eigen::MatrixXd free_multipliers(const Eigen::SparseMatrix<double>& rows_transposed,
                                 const std::vector<bool>& dependent);

}  // namespace flexneck::multibody
