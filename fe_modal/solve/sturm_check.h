// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/modal_system.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// Sentence for modes whose completeness was not checked.
inline constexpr const char* kNotChecked = "not checked";

/// The lowest modes, and a sentence on their completeness.
struct CheckedModes {
  EigenPairs pairs;
  std::string completeness;
};

/// Computes the lowest `count` modes. With a check, they are counted by a Sturm count in the first
/// gap above the last one, for which more modes are computed if necessary. If `count` cuts a
/// cluster of equal frequencies, such as the pairs of a square section or the six of a free body,
/// the sentence does not include the cluster.
/// @param rigid M-orthonormal rigid motions of the body, its first modes; may have no columns
/// @param warn takes a line if `count` cuts a cluster; may be empty
/// @throws ComputationError if the counts disagree.
CheckedModes lowest_modes(const ModalSystem& system, const LinearSolver& inverse,
                          Eigen::Index count, const Eigen::MatrixXd& rigid, bool check,
                          const Progress& warn);

/// Checks that there are no eigenvalues other than the given ones below the first gap above
/// pairs.values[count - 1]: returns the sentence that says up to where the lowest `count` are
/// complete, or nothing if there is no gap.
/// @param pairs ascending; those above `count` serve to find the gap
/// @param shift shift of the inverse; eigenvalues much smaller than it are rigid-body motions
/// @throws ComputationError if the Sturm count differs.
std::optional<std::string> check_complete(const ModalSystem& system, const EigenPairs& pairs,
                                          Eigen::Index count, double shift);

/// Checks the signs of eigenvalues.
/// @param shift shift of the inverse; values down to -1e-6 of the larger of |shift| and the largest
/// |value| are rounding
/// @throws ComputationError for values that are not numbers, or negative beyond rounding.
void check_eigenvalues(const Eigen::VectorXd& values, double shift);

/// Warns if the next eigenvalue belongs to the cluster of the last pair, unless the cluster is that
/// of the rigid-body motions.
/// @param shift shift of the inverse; not zero for a body with rigid motions
void warn_of_cut(const EigenPairs& pairs, double shift, const Progress& warn);

}  // namespace flexneck::fe_modal
