// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Solves min |A x - b| for x >= 0 by the active set method of Lawson and Hanson (Solving Least
/// Squares Problems, 1974, chapter 23). Meant for some ten unknowns.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace flexneck::pipeline
