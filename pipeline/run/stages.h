// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/files_read.h"
#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// Records in the file stages.json of a results folder, for each stage, the values it was made
/// from, the files it read (geometry/foundation/files_read.h) and wrote, by their contents, and its
/// warnings, so that a stage runs only if one of them has changed. The file is rewritten after each
/// stage, so that a stopped run continues where it was.
class Stages {
 public:
  /// Reads the records. A file of records that is missing, damaged or of another build of the
  /// program counts as none.
  /// @param redo ignores earlier records
  Stages(std::filesystem::path folder, bool redo);

  /// Returns whether all files that a stage last read and wrote are present and unchanged, and its
  /// inputs are the same.
  /// @param from the values and files it depends on, besides the files it reads
  /// @param after stages whose files it reads, as far as they have been made
  bool is_made(const std::string& stage, const Provenance& from,
               const std::vector<std::string>& after) const;

  /// Runs `work` unless the stage is made. The files that it reads and writes in the folder are
  /// detected; it must read in this thread.
  /// @return true if it ran
  /// @throws what `work` throws; the stage counts as not made then
  bool make(const std::string& stage, const Provenance& from, const std::vector<std::string>& after,
            const std::function<void()>& work);

  /// Records a warning of the running stage.
  void add_warning(const std::string& line) { told_.push_back(line); }
  /// Warnings of a stage that is made.
  const std::vector<std::string>& warnings(const std::string& stage) const;

 private:
  struct Record {
    std::string inputs;  ///< hash of the values and files that it was made from
    std::map<std::string, std::string> outputs;  ///< hash of each file by its name in the folder
    std::vector<FileRead> reads;                 ///< except the files that it has written itself
    std::vector<std::string> warnings;
  };

  std::string hash_of_inputs(const Provenance& from, const std::vector<std::string>& after) const;
  bool is_there(const Record& record) const;
  std::vector<FileRead> reads_beside_outputs(const FilesRead& reads, const Record& record) const;
  void read();
  void write() const;

  std::filesystem::path folder_;
  std::string program_;  ///< build id of the running program
  std::map<std::string, Record> records_;
  std::vector<std::string> told_;  ///< warnings of the running stage
};

}  // namespace flexneck::pipeline
