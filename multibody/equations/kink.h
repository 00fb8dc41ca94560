// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Rates of a state, and on which pieces of their laws force elements were (ForceSet::pieces()).
struct RatesAndPieces {
  Eigen::VectorXd rates;
  std::vector<int> pieces;
};

/// What has a kink at a state, where derivatives by central differences are the mean of both sides:
/// a force element that is on different pieces ahead and behind, where differences to the one side
/// and to the other are not the same. Empty if nothing has.
/// @param ahead, behind  equally far from the state
std::string kink_between(const ForceSet& forces, const RatesAndPieces& ahead,
                         const Eigen::VectorXd& at_state, const RatesAndPieces& behind);

}  // namespace flexneck::multibody
