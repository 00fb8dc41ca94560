// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/temporary_folder.h"

namespace flexneck::testing {

/// A head on a neck on a sled, with a pulse, a push, and a strap that goes slack.
std::string sled_text(const std::string& acceleration);
inline constexpr const char* kPulse =
    "acceleration = \"-150 * sin(pi * t / 0.06) * (t < 0.06)\"\ninitial_velocity = \"5 m/s\"";
inline constexpr const char* kFormulas = R"toml([[function_force]]
name = "muscle"
lower = "sled.hook"
upper = "head.top"
Fx = "-200 * x * (1 + 3 * x^2) - 4 * vx"
Fy = "20 * sin(60 * t)"
My = "-3 * ry - 0.05 * wy"
)toml";
inline const std::vector<std::string> kOutputs = {"top.x",      "top.y",      "top.z",      "nod",
                                                  "condyles.x", "condyles.y", "energy.work"};

/// A block of 2 kg on a rail along x.
std::string block_text(const std::string& analysis, const std::string& more);

/// The FMU of a model in the folder, unpacked.
std::filesystem::path unpacked(const TemporaryFolder& folder, const std::string& text);

}  // namespace flexneck::testing
