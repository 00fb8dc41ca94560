// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::pipeline {

/// Text without leading and trailing blanks and tabs.
std::string_view trimmed(std::string_view text);

/// Column name "name [unit]". The unit is empty if there are no brackets at the end.
struct CsvHeader {
  std::string name, unit;
};
CsvHeader csv_header(const std::string& cell);

/// Data lines of a CSV file, one after the other; all have as many cells as the first. Cells are
/// separated by commas, a cell with commas is in double quotes, decimals have a point, lines end in
/// LF or CRLF. Empty lines and lines that begin with # are skipped.
class CsvLines {
 public:
  /// @throws InputError if the file cannot be read or is no text (read_text()).
  explicit CsvLines(const std::filesystem::path& path);

  /// Reads the cells of the next line, without quotes; false at the end of the file.
  /// @throws InputError for another number of cells and for a quote that does not end.
  bool next(std::vector<std::string>& cells);

  /// Converts a cell to a number and multiplies it by a factor.
  /// @throws InputError if it is not a finite number.
  double number(const std::string& cell, double factor) const;

  /// @throws InputError with the file and the last line read.
  [[noreturn]] void refuse(const std::string& problem) const;

  static constexpr const char* kMarks =
      "; cells are separated by commas, and decimals have a point";

 private:
  std::vector<std::string> cells_of(const std::string& line) const;

  std::filesystem::path path_;
  std::istringstream stream_;
  int line_ = 0;
  std::size_t columns_ = 0;
};

/// Index of a column in the line of names, whose first column is the abscissa of the others.
/// Without a name it is the only other column.
/// @param how  how the name is given, for the message: "with the key 'column'"
/// @throws InputError if no column fits, or several do.
std::size_t csv_column(const CsvLines& file, const std::vector<std::string>& names,
                       const std::string& column, const std::string& how);

}  // namespace flexneck::pipeline
