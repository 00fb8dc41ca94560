// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace flexneck {

/// Origin of an input.
///  - published:  stated by a source that the note names
///  - inferred:   concluded from what is published
///  - calibrated: fitted to published results
///  - synthetic:  made up for the purpose; the default of an unlabelled input
enum class Origin { published, inferred, calibrated, synthetic };

inline constexpr std::array<std::string_view, 4> kOriginNames = {"published", "inferred",
                                                                 "calibrated", "synthetic"};

constexpr std::string_view name_of(Origin origin) {
  return kOriginNames[static_cast<std::size_t>(origin)];
}

}  // namespace flexneck
