// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/output_file.h"
#include "multibody/files/history_file.h"

namespace flexneck::pipeline {

/// Writer of channels as comma-separated values: a line with names and units, then one line per
/// time, block by block. Numbers have as many digits as are needed to read them back exactly.
/// Without commit() no file remains.
class CsvWriter {
 public:
  /// @param first  name and unit of the first column
  /// @throws InputError if the file cannot be written.
  explicit CsvWriter(const std::filesystem::path& path, std::string first = "time [s]");

  /// Appends lines of the same channels.
  void append(const Eigen::VectorXd& time_s, const std::vector<multibody::Channel>& channels);
  /// Completes the file. @throws ComputationError if writing has failed.
  void commit() { file_.commit(Durability::none); }

 private:
  OutputFile file_;
  std::string first_;  ///< name and unit, until the line of names is written
};

/// Writes a whole file. @throws as CsvWriter.
void write_csv(const std::filesystem::path& path, const Eigen::VectorXd& time_s,
               const std::vector<multibody::Channel>& channels,
               const std::string& first = "time [s]");

}  // namespace flexneck::pipeline
