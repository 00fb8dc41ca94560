// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"

namespace flexneck::pipeline {

/// The unit in which the paper and crash tests give a quantity of that SI unit; the SI unit itself
/// if none is known.
std::string customary_unit(const std::string& si_unit, const std::string& moment_unit = "lbf*ft");

/// Converts channels to the units of the paper and of crash tests: deg, in, in/s, gn, lbf, and
/// lbf*ft or `moment_unit`. Channels of other units are unchanged.
std::vector<multibody::Channel> in_customary_units(std::vector<multibody::Channel> channels,
                                                   const char* moment_unit = "lbf*ft");

}  // namespace flexneck::pipeline
