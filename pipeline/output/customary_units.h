// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/history_file.h"

namespace flexneck::pipeline {

/// Channels in the units that the paper and crash tests use: deg, in, in/s, gn, lbf, and lbf*ft or
/// `moment_unit`. Channels of other units stay as they are.
std::vector<multibody::Channel> in_customary_units(std::vector<multibody::Channel> channels,
                                                   const char* moment_unit = "lbf*ft");

}  // namespace flexneck::pipeline
