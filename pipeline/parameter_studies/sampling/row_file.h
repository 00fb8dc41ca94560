// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/files_read.h"

namespace flexneck::pipeline {

/// Checks whether files are unchanged since they were read. Each is examined once, so that all
/// answers of one object refer to one state.
class FilesNow {
 public:
  bool is_same(const FileRead& file);
  /// All files examined, in their current state.
  std::vector<FileRead> files() const;

 private:
  std::map<std::string, std::string> hashes_;  ///< by path
};

/// Result of a row.
struct RowResult {
  std::uint64_t row = 0;
  Eigen::VectorXd figures;           ///< SI; NaN where there is no value
  std::string problem;               ///< reason why a figure, or all, are missing; empty if none is
  Eigen::VectorXd curves;            ///< one after the other; NaN for a row that failed
  std::vector<FileRead> reads = {};  ///< files that the row was computed from

  bool has_failed() const { return !problem.empty(); }
};

/// Definition and sizes of the rows of a file.
struct RowFormat {
  std::string definition;  ///< hash of all values that the rows depend on
  Eigen::Index figures = 0;
  Eigen::Index curve_values = 0;  ///< number of values of all curves together
  /// Shared by all readers of one table: its rows refer to one state of their files.
  std::shared_ptr<FilesNow> files = std::make_shared<FilesNow>();
};

/// Complete lines of a file.
class WholeLines {
 public:
  explicit WholeLines(std::filesystem::path path);

  /// Reads the next line without its line break. @return false at the end, also within an
  /// incomplete last line
  /// @throws ComputationError if the file cannot be read.
  bool next(std::string& line);
  /// Number of bytes of the lines read so far.
  std::uint64_t end() const { return end_; }

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  std::string block_;
  std::size_t at_ = 0;       ///< position in the block
  std::uint64_t place_ = 0;  ///< position of the block's end in the file
  std::uint64_t end_ = 0;
};

/// Reads the rows of a file up to the first that is damaged, incomplete, or made from files that
/// have changed since: the file has a line of text for each row with a hash at its end, which
/// covers the row's curves and files. The curves are in binary in a file beside it, <name>.curves,
/// the files in a line before the first row that is made from them.
class RowReader {
 public:
  /// Opens a file; one that does not exist, or has another definition, has no rows.
  RowReader(const std::filesystem::path& path, RowFormat format);

  /// Reads the next row, without its files. @return false at the end
  /// @throws ComputationError if the file cannot be read.
  bool next(RowResult& result);
  /// The changed file because of which the following rows are invalid; empty if there is none.
  const std::string& changed() const { return changed_; }
  /// True if the file has another definition.
  bool is_of_another() const { return is_of_another_; }
  /// Number of bytes up to the end of the last row that was read, and of its curves.
  std::uint64_t end() const { return end_; }
  std::uint64_t end_of_curves() const { return end_of_curves_; }

 private:
  bool are_as_read(std::string_view line);

  RowFormat format_;
  std::filesystem::path curves_path_;
  WholeLines lines_;
  FileDescriptor curves_;
  std::string files_;  ///< line of the files that the next rows are made from
  std::string changed_;
  bool is_at_end_ = false;
  bool is_of_another_ = false;
  std::uint64_t end_ = 0;
  std::uint64_t end_of_curves_ = 0;
};

/// Appends rows to such a file. Each is passed to the system at once, so that it remains however
/// the process ends.
class RowWriter {
 public:
  /// Continues after the rows that a reader has read to the end; starts a new file if there are
  /// none.
  /// @throws InputError if the file cannot be written.
  RowWriter(const std::filesystem::path& path, const RowFormat& format, const RowReader& after);

  /// Appends a row. @throws ComputationError with the system's reason if it cannot be written.
  void append(const RowResult& result);

 private:
  void write(const FileDescriptor& file, std::string_view bytes) const;

  std::filesystem::path path_;
  FileDescriptor lines_;
  FileDescriptor curves_;
  std::string files_;  ///< line of the files that the last row was made from
};

}  // namespace flexneck::pipeline
