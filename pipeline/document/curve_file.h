// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// A column of a CSV file over its first one, the time.
struct Curve {
  std::string file;        ///< as it was named
  std::string column;      ///< its name; empty if the file has no line of names
  std::string unit;        ///< of the values; empty if the file names none
  Eigen::VectorXd time_s;  ///< shape (n), n > 1, strictly increasing
  Eigen::VectorXd values;  ///< shape (n), in that unit, finite

  /// "file: 'column' [unit]" as far as there are such.
  std::string label() const;
};

/// Reads a file as flexneck writes it, its first line with "time [ms],name [unit],…", or one of two
/// columns without such a line: seconds and values whose unit is not known.
/// @param column  by name; may be empty if there are two columns only
/// @throws InputError with file and line for what is not such a file, a column that is not there,
/// times that do not increase and what is not a finite number.
Curve read_curve(const std::filesystem::path& path, const std::string& column);

/// The curve in another unit.
/// @throws InputError with the file and the column for a unit of another dimension.
Curve in_unit(Curve curve, const std::string& unit);

}  // namespace flexneck::pipeline
