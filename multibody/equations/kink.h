// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"
#include "multibody/model/modal_springs.h"

namespace flexneck::multibody {

/// Flags of the open slits of a deformable body.
struct OpenSlits {
  std::string body;
  std::vector<bool> open;

  /// @param a  the body's modal coordinates
  OpenSlits(std::string body, const ModalSprings& springs, const Eigen::VectorXd& a);
  bool operator==(const OpenSlits&) const = default;
};

/// Rates of a state, and identifiers of the smooth pieces of its loads.
struct RatesAndPieces {
  Eigen::VectorXd rates;
  std::vector<int> pieces;       ///< pieces of force elements, ForceSet::pieces()
  std::vector<OpenSlits> slits;  ///< deformable bodies whose slits open and close
};

/// Name of a force element or body with a kink at a state, where derivatives by central differences
/// are the mean of both sides: a force element that is on different pieces ahead and behind, or a
/// body whose slits are open on one side only, while forward and backward differences disagree.
/// Empty if there is none.
/// @param ahead, behind  equally far from the state
std::string kink_between(const ForceSet& forces, const RatesAndPieces& ahead,
                         const Eigen::VectorXd& at_state, const RatesAndPieces& behind);

}  // namespace flexneck::multibody
