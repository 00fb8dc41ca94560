// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/modal_system.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// Of modes that nothing is known of.
inline constexpr const char* kNotChecked = "not checked";

/// The lowest modes, and what is known of their completeness: a sentence.
struct CheckedModes {
  EigenPairs pairs;
  std::string completeness;
};

/// The lowest `count` modes. Checked, they are counted by inertia in the first gap above the last
/// one, for which more modes are computed where they need be. Where `count` cuts a cluster of equal
/// frequencies, which a square section has in pairs and a free body six of, nothing is
/// said of the cluster.
/// @param rigid M-orthonormal rigid motions that the body keeps, its first modes; may have no
/// columns
/// @param warn takes a line if `count` cuts a cluster; may be empty
/// @throws ComputationError if the counts disagree.
CheckedModes lowest_modes(const ModalSystem& system, const LinearSolver& inverse,
                          Eigen::Index count, const Eigen::MatrixXd& rigid, bool check,
                          const Progress& warn);

/// Checks that there are no eigenvalues but those given below the first gap above
/// pairs.values[count - 1]: the sentence that says up to where the lowest `count` are complete, or
/// nothing if there is no gap.
/// @param pairs ascending, those above `count` serve to find the gap
/// @param shift of the inverse; eigenvalues much smaller than it are rigid-body motions
/// @throws ComputationError if the inertia counts another number.
std::optional<std::string> check_complete(const ModalSystem& system, const EigenPairs& pairs,
                                          Eigen::Index count, double shift);

/// @param shift of the inverse; eigenvalues are those of a body with positive stiffness otherwise
/// @throws ComputationError for values that are not numbers, or negative beyond rounding.
void check_eigenvalues(const Eigen::VectorXd& values, double shift);

/// Warns if the next eigenvalue belongs to the cluster of the last pair, unless that is of
/// rigid-body motions.
/// @param shift of the inverse; not zero for a body that keeps rigid motions
void warn_of_cut(const EigenPairs& pairs, double shift, const Progress& warn);

}  // namespace flexneck::fe_modal
