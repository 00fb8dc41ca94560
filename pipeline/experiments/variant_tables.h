// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/experiments/pendulum_tables.h"

namespace flexneck::pipeline {

/// Tables "variant-<name>", one for each variant: its cases beside their base cases.
std::vector<ResultTable> variant_tables(const Study& study,
                                        const std::vector<PendulumEntry>& entries);

/// Table "rigid necks": pivots, springs and dampers of the rigid necks that cases use, by plane.
ResultTable rigid_neck_table(const Study& study, const fe_modal::ModalBody& body);

/// Table "processor time": ratio of the deformable neck's time to that of the rigid ones in the
/// same run of the program. Measured, so that it differs from run to run.
ResultTable processor_table(const std::vector<PendulumEntry>& entries);

}  // namespace flexneck::pipeline
