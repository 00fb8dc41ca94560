// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/eigensolver.h"
#include "fe_modal/modal_system.h"

namespace flexneck::fe_modal {

/// Modes of which none is missing, and the sentence that says so.
struct CertifiedModes {
  EigenPairs pairs;
  std::string certificate;
};

/// The lowest modes, counted by inertia in a gap above the last one; more modes are computed where
/// there is no gap.
/// @throws ComputationError if the counts disagree.
CertifiedModes certified_modes(const ModalSystem& system, const ShiftInverse& inverse,
                               Eigen::Index count);

/// Proves that there is no eigenvalue below the first gap above values[count - 1] but those given:
/// the sentence that says so, or nothing if there is no gap.
/// @param values ascending, those above `count` serve to find the gap
/// @param shift of the inverse; eigenvalues much smaller than it are rigid-body motions
/// @throws ComputationError if the inertia counts another number.
std::optional<std::string> prove_complete(const ModalSystem& system, const Eigen::VectorXd& values,
                                          Eigen::Index count, double shift);

}  // namespace flexneck::fe_modal
