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
#include "pipeline/parameter_studies/fit/families.h"
#include "pipeline/parameter_studies/fit/history.h"
#include "pipeline/parameter_studies/fit/identifiability.h"
#include "pipeline/parameter_studies/fit/profile.h"
#include "pipeline/parameter_studies/fit/study_fit.h"
#include "pipeline/parameter_studies/sampling/row_file.h"

namespace flexneck::pipeline {

/// The points of the prior that were evaluated.
struct HistoryMatch {
  Eigen::MatrixXd places;  ///< (p, m) in the unit cube
  /// One list of targets met for each point; empty if the model failed.
  std::vector<std::vector<bool>> met;
  Share all;                     ///< share of points that meet all targets except those held out
  std::vector<Share> by_target;  ///< in the order of targets_of()
  std::uint64_t failed = 0;

  /// For each point, true if it meets all targets except those held out.
  std::vector<bool> is_match;
};

/// Results of a fit.
struct FitResult {
  std::vector<Minimum> minima;  ///< one per start
  std::vector<Family> families;
  Identifiability known;          ///< at the best minimum
  std::vector<Profile> profiles;  ///< one per parameter, or none
  HistoryMatch history;           ///< without points if history matching is not asked for

  const Minimum& best() const { return families.front().best; }
};

/// The steps of a fit in a folder of results: fits from all starts, profiles, history matching.
/// Finished rows are kept in fit-rows/ and are not computed again; the result is the same for any
/// number of threads and interruptions.
class FitJob {
 public:
  /// @param fit      outlives this
  /// @param targets  files that the fit's targets were read from
  /// @param stopped  set when the user stops the fit
  FitJob(StudyFit& fit, std::filesystem::path results, std::vector<FileRead> targets,
         unsigned threads, const std::atomic<bool>* stopped);

  /// The files that the rows depend on, once all rows exist.
  std::vector<FileRead> files() const { return files_now_->files(); }

  /// @param tell  takes a line now and then about the remaining work
  /// @throws FitStopped after the user's stop, once finished rows are kept; ComputationError if no
  /// start has converged, or rows cannot be written.
  FitResult run(const Progress& tell);

  /// Folder in which rows are kept.
  static std::filesystem::path folder(const std::filesystem::path& results);

 private:
  struct Step {
    std::string name;  ///< name of the file
    std::string what;  ///< description for the user
    std::uint64_t count = 0;
    Eigen::Index figures = 0;
    std::function<RowResult(std::uint64_t)> compute;
  };
  std::vector<RowResult> rows_of(const Step& step, const Progress& tell) const;
  /// The study's own start, then Sobol' points that the study accepts.
  std::vector<Eigen::VectorXd> starts() const;
  /// First place of least squares: the start, or the end of a global search from it.
  Eigen::VectorXd first_place(const Eigen::VectorXd& start, std::uint64_t number);
  std::vector<Minimum> fit_all(const Progress& tell);
  std::vector<Profile> all_profiles(const FitResult& result, const Progress& tell);
  HistoryMatch history(const Progress& tell);
  FitSearch search() const;
  /// @throws InputError if a file has changed since the earlier rows.
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
