// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/descriptor/equations_of_motion.h"

namespace flexneck::multibody {

/// Multipliers without effect on the motion, of the last factorisation: a column for each redundant
/// row.
Eigen::MatrixXd free_multipliers(const EquationsOfMotion& equations);

/// Message on motors whose freedom other motors prescribe or joints constrain already. Empty if
/// there are none.
std::string contradictory_motors(const EquationsOfMotion& equations);

/// Warnings on kept rows that nearly depend on others: each removes a degree of freedom that a
/// slight misalignment decides; and on a model that redundant joints lock.
std::vector<std::string> doubts_of_mobility(const EquationsOfMotion& equations);

}  // namespace flexneck::multibody
