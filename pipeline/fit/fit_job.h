// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/progress.h"
#include "pipeline/fit/families.h"
#include "pipeline/fit/history.h"
#include "pipeline/fit/identifiability.h"
#include "pipeline/fit/profile.h"
#include "pipeline/fit/study_fit.h"
#include "pipeline/sampling/row_file.h"

namespace flexneck::pipeline {

/// The points of the prior that were tried.
struct HistoryMatch {
  Eigen::MatrixXd places;              ///< (p, m) in the unit cube
  std::vector<std::vector<bool>> met;  ///< of each, by target; empty where the model failed
  Share all;                           ///< that meet all targets but those held out
  std::vector<Share> by_target;        ///< as targets_of() has them
  std::uint64_t failed = 0;

  /// Whether a point meets all targets but those held out.
  std::vector<bool> is_match;
};

/// What became of a fit.
struct FitResult {
  std::vector<Minimum> minima;  ///< one for each start
  std::vector<Family> families;
  Identifiability known;          ///< about the best
  std::vector<Profile> profiles;  ///< one for each parameter, or none
  HistoryMatch history;           ///< without points if none were asked for

  const Minimum& best() const { return families.front().best; }
};

/// The steps of a fit in a folder of results: fits from all starts, profiles, history matching.
/// What is done is kept in fit-rows/ and need not be done again; the result is the same for any
/// number of threads and interruptions.
class FitJob {
 public:
  /// @param fit      outlives this
  /// @param targets  files that the fit's targets were read from
  /// @param stopped  by the user
  FitJob(StudyFit& fit, std::filesystem::path results, std::vector<FileRead> targets,
         unsigned threads, const std::atomic<bool>* stopped);

  /// The files that the rows are made from, once all are there.
  std::vector<FileRead> files() const { return files_now_->files(); }

  /// @param tell  takes a line now and then about what is left
  /// @throws FitStopped once what was asked for in between is kept; ComputationError if no start
  /// has come to an end, or rows cannot be written.
  FitResult run(const Progress& tell);

  /// Where rows are kept.
  static std::filesystem::path folder(const std::filesystem::path& results);

 private:
  struct Step {
    std::string name;  ///< of the file
    std::string what;  ///< for the user
    std::uint64_t count = 0;
    Eigen::Index figures = 0;
    std::function<RowResult(std::uint64_t)> compute;
  };
  std::vector<RowResult> rows_of(const Step& step, const Progress& tell) const;
  /// The study's own, then Sobol' points that the study does not refuse.
  std::vector<Eigen::VectorXd> starts() const;
  /// Where least squares begin: at the start, or where a global search from it has ended.
  Eigen::VectorXd first_place(const Eigen::VectorXd& start, std::uint64_t number);
  std::vector<Minimum> fit_all(const Progress& tell);
  std::vector<Profile> all_profiles(const FitResult& result, const Progress& tell);
  HistoryMatch history(const Progress& tell);
  FitSearch search() const;
  /// @throws InputError if a file is not as it was for the rows before.
  void require_one_state(const RowResult& row) const;

  StudyFit& fit_;
  std::filesystem::path results_;
  std::vector<FileRead> targets_;
  std::shared_ptr<FilesNow> files_now_ = std::make_shared<FilesNow>();
  unsigned threads_;
  const std::atomic<bool>* stopped_;
  std::string definition_;
};

}  // namespace flexneck::pipeline
