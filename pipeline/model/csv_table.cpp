// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/csv_table.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
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

/// Lines that count, one after the other.
class CsvFile {
 public:
  explicit CsvFile(const std::filesystem::path& path) : path_(path), stream_(path) {
    std::error_code ignored;
    if (!stream_ || !std::filesystem::is_regular_file(path, ignored))
      throw InputError(path.string() + ": expected a table (CSV), found none that can be read");
  }

  bool next(std::vector<std::string>& cells) {
    for (std::string line; std::getline(stream_, line);) {
      ++line_;
      const std::string_view text = trimmed(line);
      if (text.empty() || text.front() == '#') continue;
      cells = cells_of(line);
      return true;
    }
    return false;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(line_) + ": " + problem);
  }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  int line_ = 0;
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

std::string name_of(const std::string& cell) {
  return std::string(trimmed(cell.substr(0, cell.find('['))));
}

std::size_t column_index(const CsvFile& file, const std::vector<std::string>& cells,
                         const std::string& column) {
  if (cells.size() < 2) file.refuse("expected at least two columns with their units");
  std::vector<std::string> names;
  for (const std::string& cell : cells) names.push_back(name_of(cell));
  if (column.empty()) {
    if (cells.size() == 2) return 1;
    std::string listed;
    for (const std::string& name : names) listed += " '" + name + "'";
    file.refuse("there are several columns; choose one with the key 'column':" + listed);
  }
  try {
    return find_name(names, column, "column");
  } catch (const InputError& error) {
    file.refuse(error.what());
  }
}

double number_in(const CsvFile& file, const std::vector<std::string>& cells, std::size_t index) {
  if (index >= cells.size())
    file.refuse("expected " + std::to_string(index + 1) + " cells, found " +
                std::to_string(cells.size()));
  const std::string& cell = cells[index];
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    file.refuse("expected a finite number, found \"" + cell + "\"");
  return value;
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
    const double value = number_in(file, cells, 0) * x.to_si;
    if (!table.x.empty() && !(value > table.x.back()))
      file.refuse("the column '" + x.name + "' must increase strictly, but " + cells[0] +
                  " follows a value that is not smaller");
    table.x.push_back(value);
    table.y.push_back(number_in(file, cells, y_index) * y.to_si);
  }
  if (table.x.empty()) file.refuse("expected rows of numbers below the columns' names");
  return table;
}

}  // namespace flexneck::pipeline
