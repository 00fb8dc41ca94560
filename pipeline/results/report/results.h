// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body_file.h"
#include "mesher/mesh/mesh_file.h"
#include "multibody/files/history_file.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// File with tables that compare several folders: not results of the folder that contains it.
inline constexpr const char* kComparisonTables = "comparison.json";

/// A run of the pendulum or of the static neck tester.
struct Experiment {
  enum class Kind { pendulum, static_test };
  Kind kind = Kind::pendulum;
  std::string name;  ///< "flexion-60", or for a variant "flexion-60-rigid"
  multibody::HistoryFile file;
};

/// An entry in the page's list of files.
struct ResultFile {
  std::string name;
  std::string hash;
  Provenance provenance;
};

/// Content of a folder that a report shows. Any part of it may be missing.
struct Results {
  std::optional<mesher::Mesh> mesh;
  std::optional<fe_modal::ModalBody> modes;
  std::vector<Experiment> experiments;  ///< the pendulum's first, in the order of the study
  std::optional<VerificationTable> verification;
  std::vector<ResultTable> tables;    ///< tables of all files, in the order of their names
  std::vector<ResultFile> files;      ///< files read, by name
  std::vector<std::string> missing;   ///< sentences: missing files and the commands that make them
  std::vector<std::string> warnings;  ///< sentences: files that exist but may be invalid
  std::vector<std::string> run_warnings;  ///< warnings recorded when the runs were made

  std::vector<std::string> all_warnings() const;
  /// Finds a run; null if it does not exist.
  const Experiment* find(Experiment::Kind kind, const std::string& name) const;
};

/// Reads the results of a folder. There is a warning for files that cannot be read, and for those
/// made by different versions of the program or with other values than the study has. A file made
/// from another file than the current one of that name is left out with a warning.
Results read_results(const std::filesystem::path& folder, const Study& study);

/// Throws InputError that describes the folder's content in place of results of a study.
[[noreturn]] void refuse_without_results(const std::filesystem::path& folder);

/// Returns whether a comes before b if digits are compared as numbers: "flexion-60" before
/// "flexion-120".
bool comes_before(const std::string& a, const std::string& b);

}  // namespace flexneck::pipeline
