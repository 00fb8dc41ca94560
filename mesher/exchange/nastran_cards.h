// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::mesher {

/// A card of Nastran's bulk data with its continuation lines.
struct NastranCard {
  std::string name;                 ///< in capitals, without the star of wide fields
  std::vector<std::string> fields;  ///< after the name, without blanks; eight a line, four if wide
  std::size_t line = 0;             ///< its first line, counted from 1
  bool has_tabs = false;            ///< there are tabs in fixed fields, which shift the columns

  /// The text of a field; empty if the card is shorter.
  std::string field(std::size_t number) const {
    return number < fields.size() ? fields[number] : std::string();
  }
};

/// Reads the cards between BEGIN BULK, or the beginning if there is none, and ENDDATA. Fields are
/// free (commas), fixed of 8 columns, or fixed of 16 (a star after the name). A line continues the
/// one whose last field has the mark in its own first field, wherever that stands; a line without a
/// mark, or with that of the line before, continues the line before.
/// @throws InputError with the line for free fields beyond those of a line, marks that no line or
/// several lines have, a line that two lines continue, a mark with + whose line is missing.
std::vector<NastranCard> read_nastran_cards(std::string_view text);

/// Number of the line with BEGIN BULK; 0 for a file without it, which is bulk data from its first
/// line on.
std::size_t nastran_bulk_line(std::string_view text);

/// The line without the comment that begins with a $.
std::string_view without_comment(std::string_view line);

}  // namespace flexneck::mesher
