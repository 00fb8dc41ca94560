// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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

/// The cards between BEGIN BULK, or else the beginning, and ENDDATA. Fields are free (commas),
/// fixed of 8 columns, or fixed of 16 (a star behind the name). A line continues the one whose last
/// field has the mark of its first, wherever that stands; a line without a mark, or with that of
/// the line before, continues the line before.
/// @throws InputError with the line for free fields beyond those of a line, marks that no line or
/// several lines have, a line that two lines continue, a mark with + whose line is missing.
std::vector<NastranCard> read_nastran_cards(std::string_view text);

/// Number of the line with BEGIN BULK; 0 for a file without it, which is bulk data from its first
/// line on.
std::size_t nastran_bulk_line(std::string_view text);

/// Without the comment behind a $.
std::string_view without_comment(std::string_view line);

}  // namespace flexneck::mesher
