// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::pipeline {

/// Without blanks and tabs at either end.
std::string_view trimmed(std::string_view text);

/// "name [unit]" of a line of names. The unit is missing where there are no brackets at the end.
struct CsvHeader {
  std::string name, unit;
};
CsvHeader csv_header(const std::string& cell);

/// Lines of a CSV file that count, one after the other; all have as many cells as the first. Commas
/// stand between cells, a cell with commas stands in double quotes, decimals have a point, lines
/// end in LF or CRLF. Empty lines and those that begin with # count for nothing.
class CsvLines {
 public:
  /// @throws InputError if the file cannot be read or is no text (read_text()).
  explicit CsvLines(const std::filesystem::path& path);

  /// Cells of the next line, without quotes; false at the end of the file.
  /// @throws InputError for another number of cells and for a quote that does not end.
  bool next(std::vector<std::string>& cells);

  /// A cell as a number, times a factor.
  /// @throws InputError if it is none, or not finite.
  double number(const std::string& cell, double factor) const;

  /// @throws InputError with the file and the line that was read last.
  [[noreturn]] void refuse(const std::string& problem) const;

  static constexpr const char* kMarks = "; commas stand between cells, and decimals have a point";

 private:
  std::vector<std::string> cells_of(const std::string& line) const;

  std::filesystem::path path_;
  std::istringstream stream_;
  int line_ = 0;
  std::size_t columns_ = 0;
};

/// Place of a column among those of the line of names, of which the first is what the others are
/// over. Without a name the only other one.
/// @param how  the name is given, for the message: "with the key 'column'"
/// @throws InputError if there is no such column, or several.
std::size_t csv_column(const CsvLines& file, const std::vector<std::string>& names,
                       const std::string& column, const std::string& how);

}  // namespace flexneck::pipeline
