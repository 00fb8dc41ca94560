// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/sweep_job.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/sampling/countdown.h"
#include "pipeline/parameter_studies/sampling/run_rows.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Reads all rows, so that the writer continues after the last, which is returned.
std::optional<std::uint64_t> read_to_end(RowReader& reader) {
  std::optional<std::uint64_t> last;
  for (RowResult row; reader.next(row);) last = row.row;
  return last;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(folder.string() + ": the folder cannot be created (" + error.message() +
                     "); choose another with -o");
}

}  // namespace

SweepJob::SweepJob(Evaluator& evaluator, const SweepRows& sweep, fs::path results)
    : evaluator_(evaluator),
      sweep_(sweep),
      results_(std::move(results)),
      wanted_(evaluator.wanted(sweep.section().outputs, sweep.section().curves)) {
  std::vector<TwoSettings> varied;
  for (std::size_t k = 0; k < sweep_.section().parameters.size(); ++k)
    varied.push_back(sweep_.two_settings(k));
  check_varied(evaluator_, varied, wanted_, "sweep", "sweep.outputs and sweep.curves");
  evaluator_.require_produced(wanted_);
  for (const OutputName& each : wanted_.figures)
    figures_.push_back({each.text, unit_of(each, evaluator_.base())});
  find_curves();
  format_.definition = definition_of(evaluator_.base());
  format_.figures = static_cast<Index>(figures_.size());
  for (const CurveColumn& each : curves_) format_.curve_values += each.time_s.size();
}

void SweepJob::find_curves() {
  if (wanted_.curves.empty()) return;
  const Evaluation base = evaluator_.evaluate({}, {{}, wanted_.curves});
  for (std::size_t k = 0; k < wanted_.curves.size(); ++k)
    curves_.push_back({wanted_.curves[k].text, unit_of_curve(wanted_.curves[k]), base.times_s[k]});
}

void SweepJob::add_curves(const Evaluation& evaluation, RowResult& result) const {
  Index start = 0;
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    const VectorXd& time_s = curves_[k].time_s;
    if (evaluation.times_s[k].size() != time_s.size() || evaluation.times_s[k] != time_s)
      throw InputError(curves_[k].name +
                       ": expected the output times of the base study, found others; remove the "
                       "curve if duration or interval are varied");
    result.curves.segment(start, time_s.size()) = evaluation.curves[k];
    start += time_s.size();
  }
}

RowResult SweepJob::computed(std::uint64_t row) {
  RowResult result;
  result.row = row;
  result.figures = VectorXd::Constant(format_.figures, kUnknown);
  result.curves = VectorXd::Constant(format_.curve_values, kUnknown);
  const FilesRead reads;
  try {
    Evaluation evaluation = evaluator_.evaluate(sweep_.settings(row), wanted_);
    add_curves(evaluation, result);
    result.figures = std::move(evaluation.figures);
    result.problem = std::move(evaluation.problem);
  } catch (const std::bad_alloc&) {
    throw;  // concerns the whole process, not the row
  } catch (const std::exception& error) {
    result.problem = error.what();
    result.curves.setConstant(kUnknown);
  }
  evaluator_.require_same_study();
  result.reads = reads.files();
  return result;
}

std::vector<bool> SweepJob::rows_in(const std::vector<fs::path>& files) const {
  std::vector<bool> there(sweep_.count(), false);
  MergedRows reading(files, format_);
  for (RowResult row; reading.next(row);)
    if (row.row < there.size()) there[row.row] = true;
  return there;
}

bool SweepJob::compute(const SweepShare& share, const Progress& tell) {
  const Shard shard = share.shard.value_or(Shard());
  const fs::path own = rows_of_shard(results_, shard);
  make_folder(own.parent_path());
  std::vector<fs::path> files = row_files(results_);
  std::vector<bool> there = rows_in(files);
  auto due = [&, next = shard.first(sweep_.count())]() mutable -> std::optional<std::uint64_t> {
    while (next < shard.end(sweep_.count()) && there[next]) ++next;
    return next < shard.end(sweep_.count()) ? std::optional(next++) : std::nullopt;
  };
  RowReader reader(own, format_);
  if (reader.is_of_another() && tell)
    tell(own.string() +
         ": belongs to another study, other values or another program version; started again");
  const std::optional<std::uint64_t> last = read_to_end(reader);
  if (!reader.changed().empty() && tell)
    tell(own.string() + ": " + reader.changed() +
         " has changed since then; the rows are computed again");
  const std::optional<std::uint64_t> first_due = decltype(due)(due)();
  if (last && first_due && *first_due < *last) {
    // Earlier rows were in a file that no longer exists, and a file is in ascending order.
    fs::remove(own);
    return compute(share, tell);
  }
  RowWriter writer(own, format_, reader);
  std::uint64_t count = 0;
  for (auto counting = due; counting();) ++count;
  if (tell) tell(fmt::format("{} rows to compute, {} already computed", count, rows_done(shard)));
  if (count == 0) return true;
  evaluator_.start();
  Countdown countdown(count, "rows", tell);
  RowRun run;
  run.next_due = due;
  run.compute = [&](std::uint64_t row) { return computed(row); };
  run.take = [&](const RowResult& result) {
    writer.append(result);
    countdown.count(result.has_failed());
  };
  run.threads = share.threads;
  run.is_stopped = share.is_stopped;
  return run_rows(run);
}

std::uint64_t SweepJob::rows_done(const Shard& shard) const {
  const std::vector<bool> there = rows_in(row_files(results_));
  const auto begin = there.begin() + static_cast<std::ptrdiff_t>(shard.first(sweep_.count()));
  const auto end = there.begin() + static_cast<std::ptrdiff_t>(shard.end(sweep_.count()));
  return static_cast<std::uint64_t>(std::count(begin, end, true));
}

std::vector<std::string> SweepJob::outdated(const Shard& shard) const {
  const std::string beside = "-of-" + std::to_string(shard.count);
  std::vector<std::string> lines;
  for (const fs::path& file : row_files(results_)) {
    RowReader reader(file, format_);
    read_to_end(reader);
    if (reader.is_of_another() && file.parent_path().filename().string().ends_with(beside))
      lines.push_back(
          file.string() +
          ": the rows belong to another study, other values or another program version");
    if (!reader.changed().empty())
      lines.push_back(file.string() + ": the rows were computed from a different version of " +
                      reader.changed());
  }
  return lines;
}

bool SweepJob::is_complete() const { return rows_done(Shard()) == sweep_.count(); }

}  // namespace flexneck::pipeline
