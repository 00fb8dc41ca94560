// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/process/child_main.h"

namespace flexneck::pipeline {

/// Tasks that this program runs in a child process of itself.
const std::vector<ChildTask>& child_tasks();

}  // namespace flexneck::pipeline
