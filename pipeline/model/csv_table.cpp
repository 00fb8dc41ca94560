// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/text_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {
namespace {

constexpr std::size_t kMaxBytes = 64U << 20U;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = line.find(',', begin);
    cells.emplace_back(trimmed(
        std::string_view(line).substr(begin, end == std::string::npos ? end : end - begin)));
  }
  return cells;
}

/// Lines that count, one after the other; all have as many cells as the first.
class CsvFile {
 public:
  explicit CsvFile(const std::filesystem::path& path)
      : path_(path), stream_(read_text(path, kMaxBytes)) {}

  bool next(std::vector<std::string>& cells) {
    for (std::string line; std::getline(stream_, line);) {
      ++line_;
      if (line.ends_with('\r')) line.pop_back();
      if (line.find('\r') != std::string::npos) refuse("expected lines that end in LF or CRLF");
      const std::string_view text = trimmed(line);
      if (text.empty() || text.front() == '#') continue;
      cells = cells_of(line);
      if (columns_ == 0) columns_ = cells.size();
      if (cells.size() != columns_)
        refuse("expected " + std::to_string(columns_) + " cells as in the line of names, found " +
               std::to_string(cells.size()) + kMarks);
      return true;
    }
    return false;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(line_) + ": " + problem);
  }

  static constexpr const char* kMarks = "; commas stand between cells, and decimals have a point";

 private:
  std::filesystem::path path_;
  std::istringstream stream_;
  int line_ = 0;
  std::size_t columns_ = 0;
};

struct Header {
  std::string name;
  double to_si;
};

/// "name [unit]"
Header header_of(const CsvFile& file, const std::string& cell, const std::string& si_unit) {
  const std::size_t open = cell.find('[');
  if (open == std::string::npos || cell.back() != ']')
    file.refuse("expected a column's name and unit such as \"time [" + si_unit + "]\", found \"" +
                cell + "\"");
  const std::string unit = cell.substr(open + 1, cell.size() - open - 2);
  try {
    return {std::string(trimmed(cell.substr(0, open))), parse_quantity("1 " + unit, si_unit)};
  } catch (const InputError& error) {
    file.refuse("column \"" + cell + "\": " + error.what());
  }
}

/// Place of the column y: the one of that name among those after the first, which is x.
std::size_t column_index(const CsvFile& file, const std::vector<std::string>& cells,
                         const std::string& column) {
  if (cells.size() < 2)
    file.refuse(std::string("expected at least two columns with their units") + CsvFile::kMarks);
  std::vector<std::string> names;
  std::string listed;
  for (std::size_t c = 1; c < cells.size(); ++c) {
    names.emplace_back(trimmed(cells[c].substr(0, cells[c].find('['))));
    listed += " '" + names.back() + "'";
  }
  if (column.empty()) {
    if (cells.size() == 2) return 1;
    file.refuse("there are several columns; choose one with the key 'column':" + listed);
  }
  if (std::count(names.begin(), names.end(), column) > 1)
    file.refuse("there are several columns '" + column + "'; names must differ");
  try {
    return 1 + find_name(names, column, "column");
  } catch (const InputError& error) {
    file.refuse(error.what());
  }
}

double number_in(const CsvFile& file, const std::string& cell, double to_si) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value * to_si))
    file.refuse("expected a finite number, found \"" + cell + "\"" +
                (cell.find_first_of(",; \t") == std::string::npos ? "" : CsvFile::kMarks));
  return value * to_si;
}

}  // namespace

TableColumns read_csv_columns(const std::filesystem::path& path, const std::string& x_unit,
                              const std::string& y_unit, const std::string& column) {
  CsvFile file(path);
  std::vector<std::string> cells;
  if (!file.next(cells)) file.refuse("expected a line with the columns' names and units");
  const std::size_t y_index = column_index(file, cells, column);
  const Header x = header_of(file, cells[0], x_unit);
  const Header y = header_of(file, cells[y_index], y_unit);
  TableColumns table;
  while (file.next(cells)) {
    const double value = number_in(file, cells[0], x.to_si);
    if (!table.x.empty() && !(value > table.x.back()))
      file.refuse("the column '" + x.name + "' must increase strictly, but " + cells[0] +
                  " follows a value that is not smaller");
    table.x.push_back(value);
    table.y.push_back(number_in(file, cells[y_index], y.to_si));
  }
  if (table.x.empty()) file.refuse("expected rows of numbers below the columns' names");
  return table;
}

}  // namespace flexneck::pipeline
