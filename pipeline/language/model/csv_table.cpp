// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/csv_table.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"
#include "pipeline/laboratory/csv_lines.h"
#include "pipeline/laboratory/curve_file.h"
#include "pipeline/laboratory/iso_mme/test_folder.h"

namespace flexneck::pipeline {
namespace {

struct Header {
  std::string name;
  double to_si;
};

/// Parses a column's header "name [unit]".
Header header_of(const CsvLines& file, const std::string& cell, const std::string& si_unit) {
  const CsvHeader header = csv_header(cell);
  if (header.unit.empty())
    file.refuse("expected a column's name and unit such as \"time [" + si_unit + "]\", found \"" +
                cell + "\"");
  try {
    return {header.name, parse_quantity("1 " + header.unit, si_unit)};
  } catch (const InputError& error) {
    file.refuse("column \"" + cell + "\": " + error.what());
  }
}

TableColumns read_mme_columns(const std::filesystem::path& path, const std::string& x_unit,
                              const std::string& y_unit, const std::string& code) {
  if (x_unit != "s")
    throw InputError(path.string() + ": expected a CSV file whose first column is in '" + x_unit +
                     "', found an ISO-MME test, whose channels are over time");
  const Curve curve = in_unit(read_curve(path, code), y_unit);
  return {{curve.time_s.begin(), curve.time_s.end()}, {curve.values.begin(), curve.values.end()}};
}

}  // namespace

TableColumns read_csv_columns(const std::filesystem::path& path, const std::string& x_unit,
                              const std::string& y_unit, const std::string& column) {
  if (names_mme_test(path)) return read_mme_columns(path, x_unit, y_unit, column);
  CsvLines file(path);
  std::vector<std::string> cells;
  if (!file.next(cells))
    file.refuse("expected a header line with the names and units of the columns");
  if (cells.size() < 2)
    file.refuse(std::string("expected at least two columns with units") + CsvLines::kMarks);
  const std::size_t y_index = csv_column(file, cells, column, "with the key 'column'");
  const Header x = header_of(file, cells[0], x_unit);
  const Header y = header_of(file, cells[y_index], y_unit);
  TableColumns table;
  while (file.next(cells)) {
    const double value = file.number(cells[0], x.to_si);
    if (!table.x.empty() && !(value > table.x.back()))
      file.refuse("the column '" + x.name + "' must increase strictly, but " + cells[0] +
                  " does not exceed the value before it");
    table.x.push_back(value);
    table.y.push_back(file.number(cells[y_index], y.to_si));
  }
  if (table.x.empty()) file.refuse("expected rows of numbers below the header line, found none");
  return table;
}

}  // namespace flexneck::pipeline
