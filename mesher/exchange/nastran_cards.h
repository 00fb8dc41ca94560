// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::mesher {

/// A card of Nastran's bulk data with its continuation lines.
struct NastranCard {
  std::string name;  ///< in capitals, without the star of wide fields
  std::vector<std::string>
      fields;             ///< behind the name, without blanks; eight a line, wide ones four
  std::size_t line = 0;   ///< the first, counted from 1
  bool has_tabs = false;  ///< in fixed fields, whose columns then are not what they seem

  /// Empty where the card is shorter.
  std::string field(std::size_t number) const {
    return number < fields.size() ? fields[number] : std::string();
  }
};

/// Calls `visit` with each card between BEGIN BULK, or else the beginning, and ENDDATA. Fields are
/// free (commas), fixed of 8 columns, or fixed of 16 (a star behind the name).
void for_each_nastran_card(std::string_view text,
                           const std::function<void(const NastranCard&)>& visit);

}  // namespace flexneck::mesher
