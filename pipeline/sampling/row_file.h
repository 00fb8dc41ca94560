// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/file_descriptor.h"
#include "pipeline/sampling/files_now.h"

namespace flexneck::pipeline {

/// What became of a row.
struct RowResult {
  std::uint64_t row = 0;
  Eigen::VectorXd figures;           ///< SI; NaN of what there is none of
  std::string problem;               ///< why a figure, or all, are missing; empty if none is
  Eigen::VectorXd curves;            ///< one after the other; NaN of a row that failed
  std::vector<FileRead> reads = {};  ///< the files that it was made from

  bool has_failed() const { return !problem.empty(); }
};

/// What rows of a file are of.
struct RowFormat {
  std::string definition;  ///< hash of all values that the rows are computed from
  Eigen::Index figures = 0;
  Eigen::Index curve_values = 0;  ///< of all curves together
  /// For all readers of one table: its rows are made from one state of their files.
  std::shared_ptr<FilesNow> files = std::make_shared<FilesNow>();
};

/// Lines of a file, each with its end.
class WholeLines {
 public:
  explicit WholeLines(std::filesystem::path path);

  /// The next line without its end. @return false at the end, also within a last line
  /// @throws ComputationError if the file cannot be read.
  bool next(std::string& line);
  /// Bytes of the lines so far.
  std::uint64_t end() const { return end_; }

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  std::string block_;
  std::size_t at_ = 0;       ///< in the block
  std::uint64_t place_ = 0;  ///< of the end of the block in the file
  std::uint64_t end_ = 0;
};

/// Reads the rows of a file up to the first that is damaged, half written, or made from files that
/// are others by now: the file is a line of text for each row with a hash at its end, which the
/// row's curves and files are part of. The curves stand in binary in a file beside it,
/// <name>.curves, the files in a line before the first row that is made from them.
class RowReader {
 public:
  /// A file that is not there, or of another definition, has no rows.
  RowReader(const std::filesystem::path& path, RowFormat format);

  /// Reads the next row, without its files. @return false at the end
  /// @throws ComputationError if the file cannot be read.
  bool next(RowResult& result);
  /// The file for whose change the rows from here on do not count; empty if there is none.
  const std::string& changed() const { return changed_; }
  /// Whether there is a file of another definition.
  bool is_of_another() const { return is_of_another_; }
  /// Bytes up to the end of the last row that was read, and of its curves.
  std::uint64_t end() const { return end_; }
  std::uint64_t end_of_curves() const { return end_of_curves_; }

 private:
  bool are_as_read(std::string_view line);

  RowFormat format_;
  std::filesystem::path curves_path_;
  WholeLines lines_;
  FileDescriptor curves_;
  std::string files_;  ///< line of those that the next rows are made from
  std::string changed_;
  bool is_at_end_ = false;
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
  std::string files_;  ///< line of those that the last row was made from
};

}  // namespace flexneck::pipeline
