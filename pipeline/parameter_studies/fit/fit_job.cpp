// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/fit_job.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/fit/global_search.h"
#include "pipeline/parameter_studies/fit/limited_fit.h"
#include "pipeline/parameter_studies/sampling/countdown.h"
#include "pipeline/parameter_studies/sampling/run_rows.h"
#include "pipeline/parameter_studies/sampling/unit_points.h"
#include "pipeline/parameter_studies/sampling/varied_key.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kFolder = "fit-rows";

/// Row of a minimum: chi-squared, evaluations, convergence, the place, the observables.
VectorXd row_of(const Minimum& minimum, Index observables) {
  VectorXd row(3 + minimum.place.size() + observables);
  row << minimum.chi_squared, minimum.evaluations, minimum.has_converged ? 1 : 0, minimum.place,
      (minimum.values.size() == observables ? minimum.values
                                            : VectorXd::Constant(observables, kUnknown));
  return row;
}

Minimum minimum_of(const RowResult& row, Index parameters) {
  Minimum minimum;
  minimum.chi_squared = row.figures[0];
  minimum.evaluations = static_cast<int>(row.figures[1]);
  minimum.has_converged = row.figures[2] == 1;
  minimum.place = row.figures.segment(3, parameters);
  minimum.values = row.figures.tail(row.figures.size() - 3 - parameters);
  minimum.problem = row.problem;
  return minimum;
}

/// Maximum number of points in the row of a profile: a walk and a search to either side.
constexpr Index kProfilePoints = 64;

double or_unknown(const std::optional<double>& value) { return value.value_or(kUnknown); }
std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

/// Row of a profile: both ends, the points, then a better minimum's chi-squared and place.
VectorXd row_of(const Profile& profile, Index parameters) {
  VectorXd row = VectorXd::Constant(3 + 2 * kProfilePoints + parameters, kUnknown);
  row[0] = or_unknown(profile.low);
  row[1] = or_unknown(profile.high);
  Index next = 2;
  for (const Profile::Point& point : profile.points) {
    row[next++] = point.place;
    row[next++] = point.chi_squared;
  }
  if (profile.better) {
    row[2 + 2 * kProfilePoints] = profile.better->chi_squared;
    row.tail(parameters) = profile.better->place;
  }
  return row;
}

Profile profile_from(const RowResult& row, Index parameters) {
  Profile profile;
  profile.low = known(row.figures[0]);
  profile.high = known(row.figures[1]);
  for (Index k = 0; k < kProfilePoints && !std::isnan(row.figures[2 + 2 * k]); ++k)
    profile.points.push_back({row.figures[2 + 2 * k], row.figures[3 + 2 * k]});
  if (!std::isnan(row.figures[2 + 2 * kProfilePoints])) {
    profile.better.emplace();
    profile.better->chi_squared = row.figures[2 + 2 * kProfilePoints];
    profile.better->place = row.figures.tail(parameters);
  }
  return profile;
}

}  // namespace

FitJob::FitJob(StudyFit& fit, fs::path results, std::vector<FileRead> targets, unsigned threads,
               const std::atomic<bool>* stopped)
    : fit_(fit),
      results_(std::move(results)),
      targets_(std::move(targets)),
      threads_(threads),
      stopped_(stopped),
      definition_(definition_of(fit.evaluator().base())) {}

fs::path FitJob::folder(const fs::path& results) { return results / kFolder; }

FitSearch FitJob::search() const { return {fit_.section().iterations, {}, stopped_}; }

void FitJob::require_one_state(const RowResult& row) const {
  for (const FileRead& file : row.reads)
    if (!files_now_->is_same(file))
      throw InputError(file.path +
                       ": the file was changed during the run; run the same command again");
}

std::vector<RowResult> FitJob::rows_of(const Step& step, const Progress& tell) const {
  const fs::path path = folder(results_) / (step.name + ".txt");
  const RowFormat format{definition_ + " " + step.name, step.figures, 0, files_now_};
  std::vector<RowResult> rows;
  RowReader reader(path, format);
  if (reader.is_of_another())
    tell(path.string() +
         ": belongs to another study, other values or another program version; started again");
  for (RowResult row; rows.size() < step.count && reader.next(row);) rows.push_back(row);
  if (!reader.changed().empty())
    tell(path.string() + ": " + reader.changed() +
         " has changed since then; the rows are computed again");
  RowWriter writer(path, format, reader);
  if (rows.size() == step.count) return rows;
  fit_.start_solvers();
  Countdown countdown(step.count - rows.size(), step.what, tell);
  RowRun run;
  run.next_due = [&, next = rows.size()]() mutable -> std::optional<std::uint64_t> {
    return next < step.count ? std::optional<std::uint64_t>(next++) : std::nullopt;
  };
  run.compute = [&](std::uint64_t number) {
    RowResult row;
    const FilesRead reads;
    note_reads(targets_);
    try {
      row = step.compute(number);
    } catch (const FitStopped&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;  // concerns the whole process, not the row
    } catch (const std::exception& error) {
      row.problem = error.what();
      row.figures = VectorXd::Constant(step.figures, kUnknown);
    }
    fit_.evaluator().require_same_study();
    row.row = number;
    row.reads = reads.files();
    return row;
  };
  run.take = [&](const RowResult& row) {
    require_one_state(row);
    writer.append(row);
    rows.push_back(row);
    countdown.count(row.has_failed());
  };
  run.threads = static_cast<unsigned>(std::min<std::uint64_t>(threads_, step.count - rows.size()));
  run.is_stopped = stopped_;
  if (!run_rows(run)) throw FitStopped();
  return rows;
}

std::vector<VectorXd> FitJob::starts() const {
  constexpr int kTries = 100;  // per start
  const int count = fit_.section().starts;
  const auto dimensions = static_cast<int>(fit_.objective().parameter_count());
  const auto seed = static_cast<std::uint64_t>(fit_.section().seed);
  std::vector<VectorXd> places = {fit_.start()};
  for (int k = 1; k <= kTries * count && static_cast<int>(places.size()) < count; ++k) {
    VectorXd point = shifted_sobol_point(static_cast<std::uint64_t>(k), dimensions, seed);
    if (fit_.is_accepted(fit_.objective().parameters(point))) places.push_back(std::move(point));
  }
  return places;
}

VectorXd FitJob::first_place(const VectorXd& start, std::uint64_t number) {
  const FitSection& section = fit_.section();
  if (section.method == FitSection::Method::local) return start;
  return best_of_search(
      with_limits_as_windows(fit_.objective()),
      [this](const VectorXd& at) { return fit_.observables(at); }, start,
      {section.evaluations, static_cast<std::uint64_t>(section.seed) + number, stopped_});
}

std::vector<Minimum> FitJob::fit_all(const Progress& tell) {
  const FitObjective& objective = fit_.objective();
  const Index parameters = objective.parameter_count();
  const auto observables = static_cast<Index>(objective.terms().size());
  const std::vector<VectorXd> places = starts();
  Step step{"starts", "fits", places.size(), 3 + parameters + observables, {}};
  step.compute = [&](std::uint64_t number) {
    const Minimum found = least_squares(objective, first_place(places[number], number), search());
    return RowResult{number, row_of(found, observables), found.problem, {}};
  };
  std::vector<Minimum> minima;
  for (const RowResult& row : rows_of(step, tell)) minima.push_back(minimum_of(row, parameters));
  return minima;
}

std::vector<Profile> FitJob::all_profiles(const FitResult& result, const Progress& tell) {
  const FitObjective& objective = fit_.objective();
  const Index parameters = objective.parameter_count();
  Step step{"profiles",
            "profiles",
            static_cast<std::uint64_t>(parameters),
            3 + 2 * kProfilePoints + parameters,
            {}};
  step.compute = [&](std::uint64_t number) {
    const auto parameter = static_cast<Index>(number);
    const Profile found = profile_of(objective, result.best(), parameter,
                                     result.known.deviation(parameter), search());
    return RowResult{number, row_of(found, parameters), {}, {}};
  };
  std::vector<Profile> profiles;
  for (const RowResult& row : rows_of(step, tell)) {
    if (row.has_failed()) throw ComputationError("profile likelihood: " + row.problem);
    profiles.push_back(profile_from(row, parameters));
  }
  return profiles;
}

HistoryMatch FitJob::history(const Progress& tell) {
  const FitObjective& objective = fit_.objective();
  const auto count = static_cast<Index>(fit_.section().history_samples);
  HistoryMatch match;
  if (count == 0) return match;
  const auto point = [&](std::uint64_t number) {
    return prior_point(objective, static_cast<std::uint64_t>(fit_.section().seed), number);
  };
  Step step{"history",
            "points of the prior",
            static_cast<std::uint64_t>(count),
            static_cast<Index>(objective.terms().size()),
            {}};
  step.compute = [&](std::uint64_t number) {
    return RowResult{number, fit_.observables(objective.parameters(point(number))), {}, {}};
  };
  const std::vector<std::pair<std::string, bool>> targets = targets_of(objective);
  std::vector<std::uint64_t> met_by(targets.size(), 0);
  std::uint64_t met_all = 0;
  match.places.resize(objective.parameter_count(), count);
  for (const RowResult& row : rows_of(step, tell)) {
    match.places.col(static_cast<Index>(row.row)) = point(row.row);
    match.met.emplace_back();
    bool is_match = !row.has_failed();
    if (is_match) {
      match.met.back() = met_targets(objective, row.figures, fit_.section().history_deviations);
      for (std::size_t k = 0; k < targets.size(); ++k) {
        met_by[k] += match.met.back()[k] ? 1U : 0U;
        is_match = is_match && (match.met.back()[k] || targets[k].second);
      }
    } else {
      ++match.failed;
    }
    match.is_match.push_back(is_match);
    met_all += is_match ? 1U : 0U;
  }
  match.all = share_of(met_all, step.count);
  for (const std::uint64_t met : met_by) match.by_target.push_back(share_of(met, step.count));
  return match;
}

FitResult FitJob::run(const Progress& tell) {
  std::error_code error;
  fs::create_directories(folder(results_), error);
  if (error)
    throw InputError(folder(results_).string() + ": the folder cannot be created (" +
                     error.message() + "); choose another with -o");
  FitResult result;
  result.minima = fit_all(tell);
  result.families = families_of(fit_.objective(), result.minima);
  if (result.families.empty())
    throw ComputationError("all fits failed; the error of the first one: " +
                           result.minima.front().problem);
  const FitObjective& objective = fit_.objective();
  result.known = identifiability(
      objective,
      objective.jacobian(objective.model().slopes(objective.parameters(result.best().place))));
  if (fit_.section().has_profiles) result.profiles = all_profiles(result, tell);
  result.history = history(tell);
  return result;
}

}  // namespace flexneck::pipeline
