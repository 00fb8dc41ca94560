// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Two columns of a table, in SI units.
struct TableColumns {
  std::vector<double> x, y;
};

/// Keys of a table that may read two of its lists from a file.
inline constexpr std::array<Key, 2> kCsvKeys = {{
    Key::file("table", kNone,
              "Instead of the lists: a CSV file with names and units in its first line; for curves "
              "over time also an ISO-MME test"),
    Key::text("column", kNone,
              "Column of that file, if it has more than two; channel code of an ISO-MME test"),
}};

/// Reads two columns of a CSV file, or, if x is a time, a channel of a test in ISO-MME
/// (laboratory/iso_mme/test_folder.h), whose code is the column's name. The CSV file's first line
/// names the columns with their units, such as "time [ms], acceleration [gn]"; x is the first.
/// Cells are separated by commas, decimals have a point, lines end in LF or CRLF. Empty lines and
/// those that begin with # are skipped.
/// @param column  name of the column y; empty if the file has two columns only
/// @throws InputError with file and line for a missing or surplus cell, a cell that is not a finite
/// number, a unit of another dimension, and an x that does not increase; and as read_curve() does.
TableColumns read_csv_columns(const std::filesystem::path& path, const std::string& x_unit,
                              const std::string& y_unit, const std::string& column);

}  // namespace flexneck::pipeline
