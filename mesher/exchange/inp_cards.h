// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::mesher {

/// Place of a line, for messages.
struct InpPlace {
  std::string file;  ///< as the user named it, or the included file
  std::size_t line = 0;

  std::string text() const { return file + ":" + std::to_string(line) + ": "; }
};

/// A line of data: its fields without surrounding blanks. A trailing comma has no field behind it.
struct InpData {
  InpPlace place;
  std::vector<std::string> fields;
  bool ends_in_comma = false;
};

/// A keyword line and the data lines that follow it.
struct InpCard {
  InpPlace place;
  std::string keyword;                            ///< capitals without the star: "SOLID SECTION"
  std::map<std::string, std::string> parameters;  ///< by name in capitals; values as written, may
                                                  ///< be empty
  std::vector<InpData> data;

  /// @throws InputError if the parameter is missing or empty.
  const std::string& parameter(const std::string& name) const;
  bool has(const std::string& name) const { return parameters.count(name) > 0; }
  /// Throws InputError "<file>:<line>: *KEYWORD: <problem>".
  [[noreturn]] void refuse(const std::string& problem) const;
};

/// The cards of an Abaqus or CalculiX input, without comments and blank lines; a keyword line that
/// ends in a comma is joined with the next. *INCLUDE is followed into files of the same folder or
/// below, and refused elsewhere: importing a mesh must not read other files of the machine.
/// @param text content of the file
/// @throws InputError with file and line.
std::vector<InpCard> read_inp_cards(const std::filesystem::path& file, const std::string& text);

std::string upper_case(std::string_view text);

/// The whole number, or the number, of a field.
/// @throws InputError with the line.
std::int64_t inp_integer(const InpData& line, std::size_t field);
double inp_number(const InpData& line, std::size_t field);

}  // namespace flexneck::mesher
