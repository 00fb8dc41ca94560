// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Which constraint rows depend on those before them: what is left of a row across the rows kept
/// before it is below 3e-6 of it, about as much as rounded input may turn it (joint_check.h).
/// Geometry alone decides; masses play no part.
/// @param rows_transposed  B^T with each velocity in metres, one column a row of B
/// @return of each row whether it depends
std::vector<bool> dependent_rows(const Eigen::MatrixXd& rows_transposed);

/// The multipliers that move nothing, B^T lambda = 0: a column for each dependent row, where its
/// multiplier is one.
Eigen::MatrixXd free_multipliers(const Eigen::MatrixXd& rows_transposed,
                                 const std::vector<bool>& dependent);

}  // namespace flexneck::multibody
