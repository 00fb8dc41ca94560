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

/// Remembers in the file stages.json of a results folder what each stage was made from, which files
/// it read (geometry/foundation/files_read.h) and which it wrote, by their contents, so that a
/// stage runs only if one of them has changed, and what it warned of. The file is written anew
/// after each stage: a run that is stopped goes on where it was.
class Stages {
 public:
  /// @param redo forgets what was made before
  /// A file of records that is missing, damaged or of another build of the program counts as none.
  Stages(std::filesystem::path folder, bool redo);

  /// Tells whether all that a stage read and wrote the last time is there, unchanged, and was made
  /// from the same.
  /// @param from the values and files it depends on, besides what it reads
  /// @param after stages whose files it reads, as far as they have been made
  bool is_made(const std::string& stage, const Provenance& from,
               const std::vector<std::string>& after) const;

  /// Runs `work` unless the stage is made. What it reads and what it writes into the folder is
  /// found by itself; it must read in this thread.
  /// @return whether it ran
  /// @throws what `work` throws; the stage counts as not made then
  bool make(const std::string& stage, const Provenance& from, const std::vector<std::string>& after,
            const std::function<void()>& work);

  /// Keeps a warning of the stage that runs.
  void add_warning(const std::string& line) { told_.push_back(line); }
  /// The warnings of a stage that is made.
  const std::vector<std::string>& warnings(const std::string& stage) const;

 private:
  struct Record {
    std::string inputs;                          ///< hash of what it was made from
    std::map<std::string, std::string> outputs;  ///< file, from the folder, to hash
    std::vector<FileRead> reads;                 ///< but for what it has written itself
    std::vector<std::string> warnings;
  };

  std::string hash_of_inputs(const Provenance& from, const std::vector<std::string>& after) const;
  bool is_there(const Record& record) const;
  std::vector<FileRead> reads_beside_outputs(const FilesRead& reads, const Record& record) const;
  void read();
  void write() const;

  std::filesystem::path folder_;
  std::string program_;  ///< build id of the running one
  std::map<std::string, Record> records_;
  std::vector<std::string> told_;  ///< by the stage that runs
};

}  // namespace flexneck::pipeline
