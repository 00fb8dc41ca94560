// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/isolation/child_main.h"

namespace flexneck::pipeline {

/// All that this program does as a child of itself.
const std::vector<ChildTask>& child_tasks();

}  // namespace flexneck::pipeline
