// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/curve_file.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"
#include "pipeline/laboratory/csv_lines.h"
#include "pipeline/laboratory/iso_mme/test_folder.h"

namespace flexneck::pipeline {
namespace {

using Cells = std::vector<std::string>;

bool is_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// Columns to read.
struct Columns {
  double time_to_s = 1;
  std::size_t index = 1;
  CsvHeader header;
};

Columns columns_of(const CsvLines& file, const Cells& cells, const std::string& column) {
  Columns columns;
  const CsvHeader time = csv_header(cells[0]);
  if (time.unit.empty())
    file.refuse(
        "expected the time with its unit in the first column, such as \"time [s]\", found \"" +
        cells[0] + "\"");
  columns.index = csv_column(file, cells, column, "by its name");
  columns.header = csv_header(cells[columns.index]);
  try {
    columns.time_to_s = parse_quantity("1 " + time.unit, "s");
  } catch (const InputError& error) {
    file.refuse("column \"" + cells[0] + "\": " + error.what());
  }
  return columns;
}

Curve read_mme_curve(const std::filesystem::path& path, const std::string& code) {
  FoundMmeChannel found = read_mme_channel(path, code);
  MmeChannel& channel = found.channel;
  Eigen::VectorXd time_s = channel.time_s();
  return {path.string(),
          channel.code,
          channel.unit,
          std::move(time_s),
          std::move(channel.values),
          std::move(found.file),
          mme_filter(channel.code)};
}

}  // namespace

std::string Curve::label() const {
  return file + (column.empty() ? "" : ": '" + column + "'") +
         (unit.empty() ? "" : " [" + unit + "]");
}

Curve read_curve(const std::filesystem::path& path, const std::string& column) {
  if (names_mme_test(path)) return read_mme_curve(path, column);
  CsvLines file(path);
  Cells cells;
  if (!file.next(cells))
    file.refuse("expected a header line with the names and units of the columns");
  if (cells.size() < 2)
    file.refuse(std::string("expected the time and at least one column of values") +
                CsvLines::kMarks);
  const bool is_plain = is_number(cells[0]);
  if (is_plain && (cells.size() > 2 || !column.empty()))
    file.refuse(
        "expected a header line with the names and units of the columns, such as \"time [s]\", "
        "since " +
        (column.empty() ? std::string("there are several columns")
                        : "the column '" + column + "' is requested"));
  const Columns columns = is_plain ? Columns() : columns_of(file, cells, column);
  std::vector<double> times_s;
  std::vector<double> values;
  for (bool has_line = is_plain || file.next(cells); has_line; has_line = file.next(cells)) {
    const double time_s = file.number(cells[0], columns.time_to_s);
    if (!times_s.empty() && !(time_s > times_s.back()))
      file.refuse("times must increase strictly, but " + cells[0] +
                  " is not later than the time before it");
    times_s.push_back(time_s);
    values.push_back(file.number(cells[columns.index], 1));
  }
  if (times_s.size() < 2) file.refuse("expected at least two rows of numbers");
  const auto count = static_cast<Eigen::Index>(times_s.size());
  return {path.string(),
          columns.header.name,
          columns.header.unit,
          Eigen::VectorXd::Map(times_s.data(), count),
          Eigen::VectorXd::Map(values.data(), count),
          path};
}

Curve in_unit(Curve curve, const std::string& unit) {
  if (curve.unit == unit) return curve;
  try {
    curve.values *= factor_from_si(curve.unit, unit);
  } catch (const InputError& error) {
    throw InputError(curve.label() + ": " + error.what());
  }
  curve.unit = unit;
  return curve;
}

bool needs_filter(const Curve& curve, multibody::ChannelClass wanted) {
  if (!curve.filter) return true;
  const MmeFilter& filter = *curve.filter;
  if (!filter.is_special && (!filter.passed || *filter.passed >= wanted))
    return filter.passed != wanted;
  throw InputError(
      curve.label() +
      ": according to the last letter of its code, the channel is already filtered with \"" +
      std::string(filter.text) + "\", from which " + name_of(wanted) +
      " cannot be obtained; use the unfiltered channel, or no filter");
}

}  // namespace flexneck::pipeline
