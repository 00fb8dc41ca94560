// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/descriptor/equations_of_motion.h"

namespace flexneck::multibody {

/// The multipliers that move nothing, of the last factorisation: a column for each redundant row.
Eigen::MatrixXd free_multipliers(const EquationsOfMotion& equations);

/// Why motors and joints cannot hold together: motors whose freedom other motors or joints give or
/// hold already. Empty if there are none.
std::string contradictory_motors(const EquationsOfMotion& equations);

/// Rows that are kept though others hold nearly the same: each takes a freedom that a slight
/// misalignment decides. And a model that joints hold more than once and lock.
std::vector<std::string> doubts_of_mobility(const EquationsOfMotion& equations);

}  // namespace flexneck::multibody
