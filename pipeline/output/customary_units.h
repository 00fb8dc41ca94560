// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"

namespace flexneck::pipeline {

/// The unit that the paper and crash tests use for a quantity of that SI unit; itself if none is
/// known.
std::string customary_unit(const std::string& si_unit, const std::string& moment_unit = "lbf*ft");

/// Channels in the units that the paper and crash tests use: deg, in, in/s, gn, lbf, and lbf*ft or
/// `moment_unit`. Channels of other units stay as they are.
std::vector<multibody::Channel> in_customary_units(std::vector<multibody::Channel> channels,
                                                   const char* moment_unit = "lbf*ft");

}  // namespace flexneck::pipeline
