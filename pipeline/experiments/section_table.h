// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/language/study/study.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Table "sections": bending stiffness of the sections in the pendulum's cases, constant or by a
/// curve, and the effect of their slits. No rows if there are no sections.
/// @param study  the study, its sections with their stiffness
ResultTable section_table(const Study& study);

}  // namespace flexneck::pipeline
