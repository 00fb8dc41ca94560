// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/analysis/campbell.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/analysis/steady_rotation.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/simulated_model.h"
#include "pipeline/experiments/relaxation_table.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/study/file_kind.h"
#include "pipeline/results/tables/campbell_output.h"
#include "pipeline/results/tables/simulated_output.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kBlockNumbers = 1 << 22;  ///< numbers of output that memory holds at once

ModelFile read(const fs::path& path, const std::vector<std::string>& settings) {
  try {
    return read_model_file(path, settings);
  } catch (const InputError&) {
    refuse_other_kind(path, FileKind::model);
    throw;
  }
}

/// Runs a computation and prefixes the model's file to the input errors that only it detects.
template <class Compute>
auto named(const ModelFile& file, const Compute& compute) {
  try {
    return compute();
  } catch (const InputError& error) {
    throw InputError(file.file.string() + ": " + error.what());
  }
}

/// Runs the model.
/// @param output takes all blocks of outputs except the last
/// @return the last block
multibody::History run(const ModelFile& file, const multibody::OutputOptions& output) {
  return named(file, [&] {
    if (file.analysis == ModelFile::Analysis::quasi_static)
      return multibody::settle(file.model, file.solver, output);
    return file.start == ModelFile::Start::equilibrium
               ? multibody::simulate_from_equilibrium(file.model, file.solver, output)
               : multibody::simulate(file.model, file.solver, output);
  });
}

std::string about(const ModelFile& file) {
  if (*file.linearised_at == multibody::LinearisedAt::given) return "given";
  return multibody::steady_rotation(file.model) ? "steady rotation" : "equilibrium";
}

std::optional<multibody::LinearisationRecord> linearised(const ModelFile& file) {
  if (!file.linearised_at) return {};
  return named(file, [&] {
    return multibody::LinearisationRecord{about(file), names_of(file.model.markers),
                                          multibody::linearise(file.model, *file.linearised_at)};
  });
}

std::optional<multibody::CampbellDiagram> campbell(const ModelFile& file) {
  if (file.rates_rad_s.empty()) return {};
  return named(file, [&] { return multibody::campbell_diagram(file.model, file.rates_rad_s); });
}

/// Names of the files with a model's results.
struct ResultPaths {
  std::string name;
  fs::path history, table;
};

ResultPaths paths_of(const FileInput& input, const fs::path& model) {
  const std::string name = model.stem().string();
  return {name, input.folder.file(name + ".h5"), input.folder.file(name + ".csv")};
}

void warn_of_kink(const FileInput& input, const std::string& name,
                  const multibody::SystemMode& mode) {
  if (!mode.kink.empty())
    input.console.warning(
        name + ": the modes use the mean stiffness of both sides of a kink: " + mode.kink);
}

std::string about_expressions(const ModelFile& file) {
  return file.has_expressions
             ? fmt::format("\n  resolution of expressions of time: {:.6g} ms (solver.resolution)",
                           1e3 * file.solver.resolution_s)
             : "";
}

void tell(const FileInput& input, const ModelFile& file, const ResultPaths& paths,
          const multibody::HistoryFile& result, const PeakTable& peaks) {
  input.console.result(paths.name + ": " + paths.history.string() + ", " + paths.table.string() +
                       "\n" + run_summary(result.history) + about_expressions(file) + "\n\n" +
                       (result.linearisation ? mode_summary(*result.linearisation) + "\n\n" : "") +
                       peaks.text());
  const ResultTable relaxation = relaxation_table(file.model, file.relaxations);
  if (!relaxation.rows.empty()) input.console.result("\n" + printed(relaxation));
  for (const std::string& warning : result.history.warnings)
    input.console.warning(paths.name + ": " + warning);
  if (result.linearisation && !result.linearisation->modes.empty())
    warn_of_kink(input, paths.name, result.linearisation->modes.front().mode);
}

multibody::OutputOptions outputs_of(const ModelFile& file) {
  return {.end_time_s = file.end_time_s,
          .interval_s = file.output.interval_s,
          .states = file.output.states,
          .begin_time_s = file.model.start.time_s};
}

void write(const FileInput& input, const std::string& model,
           const multibody::CampbellDiagram& diagram) {
  input.folder.make();
  const std::string name = model + "-campbell";
  const fs::path table = input.folder.file(name + ".csv");
  const fs::path picture = input.folder.file(name + ".svg");
  write_campbell_table(table, diagram);
  draw_campbell(picture, diagram);
  input.console.result("Campbell diagram: " + table.string() + ", " + picture.string());
  for (std::size_t r = 0; r < diagram.rates_rad_s.size(); ++r)
    for (const auto& mode : diagram.modes)
      if (!mode[r].kink.empty())
        return warn_of_kink(
            input, fmt::format("{}-campbell at {:.6g} rad/s", model, diagram.rates_rad_s[r]),
            mode[r]);
}

}  // namespace

void simulate_model(const ModelFile& file, const FileInput& input) {
  const auto linearisation = linearised(file);
  const auto diagram = campbell(file);
  input.folder.make();
  const ResultPaths paths = paths_of(input, file.file);
  multibody::OutputOptions options = outputs_of(file);
  SimulatedOutput output(file, paths.history, paths.table, multibody::OutputTimes(options).count());
  options.sink = [&](const multibody::History& block) { output.append(block); };
  options.block = std::max<Eigen::Index>(1, kBlockNumbers / numbers_per_output(file.model));
  const auto finish = [&](const multibody::History& last) {
    tell(input, file, paths, output.finish(last, linearisation), output.peaks());
    if (diagram) write(input, paths.name, *diagram);
  };
  try {
    finish(run(file, options));
  } catch (const multibody::IncompleteRun& stopped) {
    finish(stopped.history);
    throw ComputationError(file.file.string() + ": " + stopped.what() +
                           "; the results up to that time are kept and marked incomplete");
  }
}

SimulatedModel simulated(const ModelFile& file) {
  if (!file.rates_rad_s.empty())
    throw InputError(
        file.file.string() +
        ": linearisation.rates: a Campbell diagram needs a folder of results; name one");
  const auto linearisation = linearised(file);
  const multibody::OutputOptions options = outputs_of(file);
  SimulatedOutput output(file, {}, {}, multibody::OutputTimes(options).count());
  try {
    return {output.finish(run(file, options), linearisation), {}};
  } catch (const multibody::IncompleteRun& stopped) {
    return {output.finish(stopped.history, linearisation),
            file.file.string() + ": " + stopped.what()};
  }
}

bool simulate_command(const FileInput& input) {
  if (input.files.size() != 1)
    throw InputError("simulate: expected one model, as in 'flexneck simulate MODEL.toml'");
  const fs::path model = named_file(input.files.front());
  ModelFile file = read(model, input.settings);
  file.solver.checkpoint = input.console.checkpoint();
  for (const std::string& warning : file.warnings) input.console.warning(warning);
  input.console.step("Simulating " + model.string());
  simulate_model(file, input);
  return true;
}

}  // namespace flexneck::pipeline
