// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"
#include "pipeline/parameter_studies/sampling/interrupt.h"
#include "pipeline/parameter_studies/sweep/sweep_job.h"
#include "pipeline/parameter_studies/sweep/sweep_summary.h"
#include "pipeline/process/customary_units.h"
#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/sweep_pictures.h"
#include "pipeline/results/tables/csv_output.h"
#include "pipeline/run/folder_lock.h"

namespace flexneck::pipeline {

namespace {

/// Parses "2/8". @throws InputError if it is not a valid part of a whole.
std::optional<Shard> shard_from(const std::string& text) {
  if (text.empty()) return {};
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = has_slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  constexpr std::uint64_t kMax = 1'000'000;
  if (!has_slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 ||
      shard.index > shard.count || shard.count > kMax)
    throw InputError("--shard: expected a part such as 2/8, found '" + text + "'");
  return shard;
}

SweepShare share_of(const CommandInput& input) {
  SweepShare share;
  share.shard = shard_from(input.shares.shard);
  share.threads = threads_of(input);
  share.is_stopped = &Interrupt::is_asked();
  return share;
}

Provenance provenance_of_sweep(const Study& study, const SweepJob& job) {
  Provenance provenance = provenance_of(study.files, study.parameters);
  const std::vector<InputFile> files = input_files(job.files());
  provenance.inputs.insert(provenance.inputs.end(), files.begin(), files.end());
  return provenance;
}

/// Removes pictures and bands of an earlier sweep, which may have had other outputs.
void remove_former(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> former;
  for (const std::filesystem::directory_entry& each : std::filesystem::directory_iterator(folder)) {
    const std::string name = each.path().filename().string();
    if (name.starts_with("sweep-") && (name.ends_with(".svg") || name.ends_with(".csv")))
      former.push_back(each.path());
  }
  for (const std::filesystem::path& each : former) std::filesystem::remove(each);
}

std::vector<Eigen::MatrixXd> write_bands(const CommandInput& input, const SweepJob& job,
                                         const SweepRows& sweep) {
  if (job.curves().empty()) return {};
  std::vector<Eigen::MatrixXd> bands = percentile_bands(
      job.curves(), [&] { return job.rows(); }, sweep.count());
  for (std::size_t k = 0; k < bands.size(); ++k) {
    const CurveColumn& curve = job.curves()[k];
    multibody::Channel channel{curve.name, curve.unit, {}, bands[k], ""};
    for (const double share : kBandShares)
      channel.columns.push_back(fmt::format("{:.0f} %", 100 * share));
    const std::filesystem::path path =
        input.folder.file("sweep-bands-" + file_part_of(curve.name) + ".csv");
    write_csv(path, curve.time_s, in_customary_units({channel}));
    input.console.result("Percentile bands: " + path.string());
  }
  return bands;
}

/// Draws the pictures; the sweep is valid without them, too.
void draw(const CommandInput& input, const SweepPictures& pictures) {
  try {
    const std::vector<std::string> names = draw_sweep(pictures, input.folder.path());
    if (names.empty()) return;
    input.console.result(fmt::format("Pictures: {} of sweep-*.svg in {}", names.size(),
                                     input.folder.path().string()));
  } catch (const InputError& error) {
    input.console.warning(std::string("the pictures of the sweep cannot be drawn: ") +
                          error.what());
  }
}

/// Copy of a table with some of its columns and without its notes.
ResultTable shortened(const ResultTable& table, const std::vector<std::size_t>& columns) {
  ResultTable brief{table.name, table.title, {}, {}, {}};
  for (const std::size_t k : columns) brief.columns.push_back(table.columns[k]);
  for (const std::vector<std::string>& row : table.rows) {
    brief.rows.emplace_back();
    for (const std::size_t k : columns) brief.rows.back().push_back(row[k]);
  }
  return brief;
}

/// Prints shortened tables that fit a terminal; with --verbose the tables in full.
void show(const CommandInput& input, const std::vector<ResultTable>& tables) {
  static const std::map<std::string, std::vector<std::size_t>> kShort = {
      {"percentiles", {0, 1, 6, 8, 10}}, {"sobol indices", {0, 1, 2, 5}}};
  for (const ResultTable& table : tables) {
    const auto brief = kShort.find(table.name);
    const bool is_short = brief != kShort.end() && !input.console.is_verbose();
    input.console.result("\n" + printed(is_short ? shortened(table, brief->second) : table));
  }
}

/// Fails for a sweep that never produces one of its outputs.
void require_outputs(const SweepJob& job, const SweepTable& table) {
  if (table.failed == 0) return;
  const auto most =
      std::max_element(table.reasons.begin(), table.reasons.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::string why =
      "not computed in any row of the sweep; the most frequent reason: " + most->first;
  for (std::size_t k = 0; k < job.figures().size(); ++k)
    if (table.figures.row(static_cast<Eigen::Index>(k)).array().isNaN().all())
      throw ComputationError("output '" + job.figures()[k].name + "': " + why);
  if (job.figures().empty() && table.failed == static_cast<std::uint64_t>(table.figures.cols()))
    throw ComputationError("curve '" + job.curves().front().name + "': " + why);
}

/// Assembles the sweep's table in one process, under a lock: several shards may each find that they
/// are the last.
void assemble(const CommandInput& input, const SweepJob& job, const SweepRows& sweep) {
  std::optional<FolderLock> lock;
  try {
    lock.emplace(input.folder.path(), "sweep",
                 [&](const std::string& warning) { input.console.warning(warning); });
  } catch (const InputError& error) {
    if (input.shares.shard.empty()) throw;
    input.console.step(std::string("The table is not assembled by this process: ") + error.what());
    return;
  }
  const Provenance provenance = provenance_of_sweep(input.study, job);
  MergedRows rows = job.rows();
  const std::filesystem::path csv = input.folder.file("sweep.csv");
  const SweepTable table =
      write_sweep_table(csv, input.folder.file("sweep.h5"), sweep, job.figures(), rows, provenance);
  const std::vector<Sensitivity> sensitivity = sensitivities(sweep, table);
  const std::vector<ResultTable> tables = sweep_tables(sweep, job.figures(), table, sensitivity);
  write_tables(input.folder.file("sweep.json"), tables, provenance);
  show(input, tables);
  remove_former(input.folder.path());
  const std::vector<Eigen::MatrixXd> bands = write_bands(input, job, sweep);
  draw(input, {sweep, job.figures(), table, sensitivity, job.curves(), bands});
  input.console.result(
      fmt::format("\nSweep: {} rows, {} failed  ({})", sweep.count(), table.failed, csv.string()));
  require_outputs(job, table);
}

/// Handles rows that are missing although this process has computed all of its own: rows of other
/// parts, which are awaited, or rows whose files have changed, of which no table is made.
void refuse_or_wait(const CommandInput& input, const SweepJob& job, const Shard& shard,
                    const SweepRows& sweep) {
  const std::vector<std::string> outdated = job.outdated(shard);
  const std::uint64_t own = shard.end(sweep.count()) - shard.first(sweep.count());
  if (job.rows_done(shard) < own)
    throw InputError((outdated.empty() ? "rows of this sweep were removed" : outdated.front()) +
                     "; run the same command again to recompute them");
  for (const std::string& line : outdated)
    input.console.warning(line + "; run that part again, since the table cannot be made from both");
  input.console.result("Part " + shard.name() +
                       " is complete; the table is made when all parts are complete");
}

}  // namespace

bool sweep_command(const CommandInput& input) {
  const SweepShare share = share_of(input);
  const SweepRows sweep(read_sweep(input.study.file, input.study.settings));
  const std::filesystem::path& results = input.folder.path();
  Evaluator evaluator({input.study.file, input.study.settings}, input.console);
  const Shard shard = share.shard.value_or(Shard());
  const FolderLock lock(folder_of_shard(results, shard), "sweep",
                        [&](const std::string& warning) { input.console.warning(warning); });
  SweepJob job(evaluator, sweep, results);
  input.console.step(fmt::format(
      "Sweep of {}: {} rows, parameters: {}{}; threads: {}", input.study.file.string(),
      sweep.count(), sweep.section().parameters.size(),
      share.shard ? ", part " + std::to_string(shard.index) + " of " + std::to_string(shard.count)
                  : "",
      share.threads));
  const Interrupt interrupt;
  const bool is_done =
      job.compute(share, [&](const std::string& line) { input.console.step(line); });
  if (!is_done)
    throw ComputationError(fmt::format(
        "stopped; {} of {} rows are complete and kept; run the same command again to continue",
        job.rows_done(shard), shard.end(sweep.count()) - shard.first(sweep.count())));
  if (job.is_complete()) {
    assemble(input, job, sweep);
    return true;
  }
  refuse_or_wait(input, job, shard, sweep);
  return true;
}

}  // namespace flexneck::pipeline
