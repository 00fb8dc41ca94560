// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/file_descriptor.h"

namespace flexneck::pipeline {

/// What became of a row.
struct RowResult {
  std::uint64_t row = 0;
  Eigen::VectorXd figures;  ///< SI; NaN of what there is none of
  std::string problem;      ///< why a figure, or all, are missing; empty if none is
  Eigen::VectorXd curves;   ///< one after the other; NaN of a row that failed

  bool has_failed() const { return !problem.empty(); }
};

/// What rows of a file are of.
struct RowFormat {
  std::string definition;  ///< hash of all that the rows are computed from
  Eigen::Index figures = 0;
  Eigen::Index curve_values = 0;  ///< of all curves together
};

/// Reads the rows of a file up to the first that is damaged or half written: the file is a line of
/// text for each row with a hash at its end, which the row's curves are part of; these stand in
/// binary in a file beside it, <name>.curves.
class RowReader {
 public:
  /// A file that is not there, or of another definition, has no rows.
  RowReader(const std::filesystem::path& path, RowFormat format);

  /// Reads the next row. @return false at the end
  bool next(RowResult& result);
  /// Whether there is a file of another definition.
  bool is_of_another() const { return is_of_another_; }
  /// Bytes up to the end of the last row that was read, and of its curves.
  std::uint64_t end() const { return end_; }
  std::uint64_t end_of_curves() const { return end_of_curves_; }

 private:
  RowFormat format_;
  std::ifstream lines_;
  std::ifstream curves_;
  bool is_of_another_ = false;
  std::uint64_t end_ = 0;
  std::uint64_t end_of_curves_ = 0;
};

/// Adds rows to such a file. Each is given to the system at once, so that it stays however the
/// process ends.
class RowWriter {
 public:
  /// Goes on after the rows that a reader has read to the end; begins a file anew if there are
  /// none.
  /// @throws InputError if the file cannot be written.
  RowWriter(const std::filesystem::path& path, const RowFormat& format, const RowReader& after);

  /// @throws ComputationError with the system's reason if it cannot be written.
  void append(const RowResult& result);

 private:
  void write(const FileDescriptor& file, std::string_view bytes) const;

  std::filesystem::path path_;
  FileDescriptor lines_;
  FileDescriptor curves_;
};

}  // namespace flexneck::pipeline
