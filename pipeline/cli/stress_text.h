// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/static_solution.h"

namespace flexneck::pipeline {

/// Text with the loads, the resultants of loads and reactions, the largest displacement, and for
/// each material the largest stress at its nodes.
std::string stress_text(const fe_modal::StaticSolution& solution);

}  // namespace flexneck::pipeline
