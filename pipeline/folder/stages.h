// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// Remembers in the file stages.json of a results folder what each stage was made from and which
/// files it wrote, by their contents, so that a stage runs only if one of them has changed. The
/// file is written anew after each stage: a run that is stopped goes on where it was.
class Stages {
 public:
  /// @param redo forgets what was made before
  /// A file of records that is missing, damaged or of another build of the program counts as none.
  Stages(std::filesystem::path folder, bool redo);

  /// Whether all that a stage wrote the last time is there, unchanged, and was made from the same.
  /// @param from the values and files it depends on, besides what earlier stages wrote
  /// @param after stages whose files it reads, as far as they have been made
  bool is_made(const std::string& stage, const Provenance& from,
               const std::vector<std::string>& after) const;

  /// Runs `work` unless the stage is made. What it writes into the folder is found by itself.
  /// @return whether it ran
  /// @throws what `work` throws; the stage counts as not made then
  bool make(const std::string& stage, const Provenance& from, const std::vector<std::string>& after,
            const std::function<void()>& work);

 private:
  struct Record {
    std::string inputs;                          ///< hash of what it was made from
    std::map<std::string, std::string> outputs;  ///< file, from the folder, to hash
  };

  std::string hash_of_inputs(const Provenance& from, const std::vector<std::string>& after) const;
  bool is_there(const Record& record) const;
  void read();
  void write() const;

  std::filesystem::path folder_;
  std::string program_;  ///< build id of the running one
  std::map<std::string, Record> records_;
};

}  // namespace flexneck::pipeline
