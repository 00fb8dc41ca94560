// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/output/result_table.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// "sections": of the sections in the pendulum's cases the stiffness against bending, whether it is
/// constant or follows a curve, and what their slits do. No rows where there are none.
/// @param study  its sections with their stiffness
ResultTable section_table(const Study& study);

}  // namespace flexneck::pipeline
