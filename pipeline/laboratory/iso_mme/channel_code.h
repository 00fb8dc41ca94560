// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "multibody/signals/cfc_filter.h"

namespace flexneck::pipeline {

/// Channel codes of ISO/TS 13499 have sixteen letters and digits, such as 11NECKUP00H3MOYB: test
/// object, position, main location (4), fine locations 1 to 3 (2 each, the third the dummy),
/// physical dimension (2), direction, filter class.
inline constexpr std::size_t kMmeCodeLength = 16;

bool is_mme_code(std::string_view text);

/// Filter of a signal by the last letter of its code.
struct MmeFilter {
  char letter = '0';
  std::string_view text;  ///< text such as "CFC 600", as in flexneck's channels
  /// Widest class that the signal has passed; none if no frequency that CFC 1000 passes is lost.
  std::optional<multibody::ChannelClass> passed = {};
  bool is_special = false;  ///< filtered in a way that no class describes
};

/// The filter of a code; a letter that is not in the standard is special.
MmeFilter mme_filter(std::string_view code);

/// Letter for the filter of a channel of flexneck ("" or "CFC 180"); 'S', special, for any other
/// text.
char mme_filter_letter(std::string_view filter);

/// SI unit of the physical dimension of a code, such as "N*m" for MO; empty if the standard fixes
/// none, and for dimensions not in the table.
std::string_view mme_si_unit(std::string_view code);

/// Physical dimension of a unit, such as "MO" for "N*m"; "00", others, for a unit without one.
std::string_view mme_dimension(std::string_view si_unit);

/// Converts a unit of the standard ("Nm") to flexneck's ("N*m"), and back.
std::string unit_from_mme(const std::string& unit, std::string_view code);
std::string unit_to_mme(const std::string& unit);

}  // namespace flexneck::pipeline
