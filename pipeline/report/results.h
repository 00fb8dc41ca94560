// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body_file.h"
#include "mesher/mesh/mesh_file.h"
#include "multibody/files/history_file.h"
#include "pipeline/output/result_table.h"
#include "pipeline/study/study.h"
#include "pipeline/verification/verification.h"

namespace flexneck::pipeline {

/// Tables of several folders side by side: not results of the folder that they are written into.
inline constexpr const char* kComparisonTables = "comparison.json";

/// A run of the pendulum or of the static neck tester.
struct Experiment {
  enum class Kind { pendulum, static_test };
  Kind kind = Kind::pendulum;
  std::string name;  ///< "flexion-60", or of a variant "flexion-60-rigid"
  multibody::HistoryFile file;
};

/// A file as the page lists it.
struct ResultFile {
  std::string name;
  std::string hash;
  Provenance provenance;
};

/// Everything that a folder holds and a report shows. Any part of it may be missing.
struct Results {
  std::optional<mesher::Mesh> mesh;
  std::optional<fe_modal::ModalBody> modes;
  std::vector<Experiment> experiments;  ///< the pendulum's first, as the study has them
  std::optional<VerificationTable> verification;
  std::vector<ResultTable> tables;        ///< of all files, in the order of their names
  std::vector<ResultFile> files;          ///< those read, by name
  std::vector<std::string> missing;       ///< sentences: what is not there and what makes it
  std::vector<std::string> warnings;      ///< sentences: what is there and should not be trusted
  std::vector<std::string> run_warnings;  ///< the same of runs, as they were told when made

  std::vector<std::string> all_warnings() const;
  /// Null if it is not there.
  const Experiment* find(Experiment::Kind kind, const std::string& name) const;
};

/// Reads what there is. Files that cannot be read, that were made by different versions of the
/// program or with other values than the study has become warnings. Left out with a warning is what
/// was made from another file than the one of that name in the folder.
Results read_results(const std::filesystem::path& folder, const Study& study);

/// @throws InputError that says what a folder holds in place of results of a study.
[[noreturn]] void refuse_without_results(const std::filesystem::path& folder);

/// Whether a comes before b where digits count as numbers: "flexion-60" before "flexion-120".
bool comes_before(const std::string& a, const std::string& b);

}  // namespace flexneck::pipeline
