// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/campbell.h"
#include "multibody/history_file.h"
#include "multibody/steady_rotation.h"
#include "pipeline/commands/file_commands.h"
#include "pipeline/model/model_file.h"
#include "pipeline/output/campbell_output.h"
#include "pipeline/output/csv_output.h"
#include "pipeline/output/summary.h"
#include "pipeline/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// What the model gets wrong that only its computation shows.
template <class Compute>
auto named(const ModelFile& file, const Compute& compute) {
  try {
    return compute();
  } catch (const InputError& error) {
    throw InputError(file.file.string() + ": " + error.what());
  }
}

multibody::History run(const ModelFile& file) {
  const multibody::OutputOptions output{file.end_time_s, file.output.interval_s};
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

template <class Histories>
void keep(Histories& histories, const std::vector<std::string>& names) {
  std::erase_if(histories, [&](const auto& each) {
    return std::find(names.begin(), names.end(), each.name) == names.end();
  });
}

/// The channels need all markers; what is written of markers and joints is what was asked for.
multibody::HistoryFile result_of(const ModelFile& file, multibody::History history) {
  multibody::HistoryFile result;
  const auto derive = [&](const std::vector<ChannelSpec>& specs) {
    for (const ChannelSpec& spec : specs)
      result.channels.push_back(channel_of(history, spec, file.model.gravity_m_s2));
  };
  derive(file.output.channels);
  keep(history.markers, file.output.markers);
  keep(history.joints, file.output.joints);
  if (file.output.channels.empty()) derive(all_channels(history));
  result.history = std::move(history);
  result.provenance = provenance_of(file.files, file.parameters);
  return result;
}

void write(const FileInput& input, const multibody::HistoryFile& result) {
  input.folder.make();
  const std::string name = input.files.front().stem().string();
  const fs::path table = input.folder.file(name + ".csv");
  multibody::write_history(input.folder.file(name + ".h5"), result);
  write_csv(table, result.history.time_s, result.channels);
  PeakTable peaks;
  peaks.append(result.history.time_s, result.channels);
  input.console.result(name + ": " + input.folder.file(name + ".h5").string() + ", " +
                       table.string() + "\n" + run_summary(result.history) + "\n\n" +
                       (result.linearisation ? mode_summary(*result.linearisation) + "\n\n" : "") +
                       peaks.text());
  for (const std::string& warning : result.history.warnings)
    input.console.warning(name + ": " + warning);
}

void write(const FileInput& input, const multibody::CampbellDiagram& diagram) {
  input.folder.make();
  const std::string name = input.files.front().stem().string() + "-campbell";
  const fs::path table = input.folder.file(name + ".csv");
  const fs::path picture = input.folder.file(name + ".svg");
  write_campbell_table(table, diagram);
  draw_campbell(picture, diagram);
  input.console.result("Campbell diagram: " + table.string() + ", " + picture.string());
}

}  // namespace

bool simulate_command(const FileInput& input) {
  if (input.files.size() != 1)
    throw InputError("simulate: name one model, 'flexneck simulate MODEL.toml'");
  const std::filesystem::path& model = input.files.front();
  const ModelFile file = read_model_file(model, input.settings);
  input.console.step("Simulating " + model.string());
  const auto linearisation = linearised(file);
  const auto diagram = campbell(file);
  const auto finish = [&](multibody::History history) {
    multibody::HistoryFile result = result_of(file, std::move(history));
    result.linearisation = linearisation;
    write(input, result);
    if (diagram) write(input, *diagram);
  };
  try {
    finish(run(file));
  } catch (const multibody::IncompleteRun& stopped) {
    finish(stopped.history);
    throw ComputationError(file.file.string() + ": " + stopped.what() +
                           "; what was computed until then is kept, marked incomplete");
  }
  return true;
}

}  // namespace flexneck::pipeline
