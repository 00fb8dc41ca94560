// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/model_file.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/assemblies.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/channel_section.h"
#include "pipeline/language/model/model_check.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/restart.h"
#include "pipeline/language/model/solver_steps.h"
#include "pipeline/language/model/start_check.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> analyses() { return {"motion", "quasi_static"}; }
std::vector<std::string> starts() { return {"given", "equilibrium"}; }
std::vector<std::string> linearised_about() { return {"equilibrium", "given"}; }

constexpr auto kSolverKeys = joined(
    std::to_array<Key>({
        Key::quantity("end_time", "s", kRequired, "End time of the run, which starts at 0",
                      {.range = kPositive}),
        Key::text("analysis", "motion", "Motion, or static equilibrium at each output time",
                  {.choices = analyses}),
        Key::text("start", "given",
                  "Initial state: as given for the bodies, or static equilibrium relative to the "
                  "prescribed bodies",
                  {.choices = starts}),
        Key::quantities("gravity", "m/s^2", kNone,
                        "Acceleration of gravity, in the world (default: none)", {.size = 3}),
    }),
    kStepKeys);

constexpr Key kLinearisationKeys[] = {
    Key::text("about", kRequired,
              "State about which the model is linearised: equilibrium or steady rotation, or the "
              "given state",
              {.choices = linearised_about}),
    Key::quantities("rates", "rad/s", kNone, "Rates of rotation for a Campbell diagram"),
};

constexpr Key kOutputKeys[] = {
    Key::quantity("interval", "s", "0.001", "Output interval", {.range = kPositive}),
    Key::texts("markers", kNone, "Markers whose histories are written (default: all)"),
    Key::texts("joints", kNone, "Joints whose histories are written (default: all)"),
    Key::flag("states", "false",
              "Write the states of all bodies, from which another run can be restarted"),
};

void read_solver(const StudyTable& table, ModelFile& file) {
  read_steps(table, file.solver);
  file.analysis = static_cast<ModelFile::Analysis>(table.choice("analysis"));
  if (file.analysis == ModelFile::Analysis::quasi_static) {
    table.refuse_given(
        {"start"},
        "has no effect in a quasi-static analysis, which is always at rest; remove this key");
    table.refuse_given(
        {"integrator", "spectral_radius", "max_step", "min_step", "max_steps"},
        "has no effect in a quasi-static analysis, which takes no time steps; remove this key");
  }
  file.start = static_cast<ModelFile::Start>(table.choice("start"));
  if (table.has("gravity")) file.model.gravity_m_s2 = quantity_vector(table, "gravity");
  file.end_time_s = table.quantity("end_time");
  table.finish();
}

void read_linearisation(const StudyTable& root, ModelFile& file) {
  if (!root.has("linearisation")) return;
  const StudyTable table = root.table("linearisation");
  file.linearised_at = static_cast<multibody::LinearisedAt>(table.choice("about"));
  if (table.has("rates")) {
    file.rates_rad_s = table.quantities("rates");
    if (file.linearised_at != multibody::LinearisedAt::equilibrium)
      table.refuse("rates",
                   "a Campbell diagram needs a linearisation about steady rotation; set about = "
                   "\"equilibrium\"");
  }
  table.finish();
}

std::vector<std::string> chosen(const StudyTable& table, const std::string& key,
                                const std::vector<std::string>& all, const std::string& kind) {
  if (!table.has(key)) return all;
  std::vector<std::string> names = table.texts(key);
  for (const std::string& name : names) {
    try {
      find_name(all, name, kind);
    } catch (const InputError& error) {
      table.refuse(key, error.what());
    }
  }
  return names;
}

void read_output(const StudyTable& root, ModelFile& file) {
  const StudyTable table = root.table("output");
  OutputSection& output = file.output;
  output.interval_s = table.quantity("interval");
  output.markers = chosen(table, "markers", names_of(file.model.markers), "marker");
  output.joints = chosen(table, "joints", names_of(file.model.joints), "joint");
  output.states = table.flag("states");
  if (output.states && file.analysis == ModelFile::Analysis::quasi_static)
    table.refuse("states", "a quasi-static analysis has no states; remove this key");
  table.finish();
  for (const StudyTable& channel : root.tables("channel"))
    output.channels.push_back(read_channel(channel, file.model, output.interval_s));
  check_names(names_of(output.channels), "channel");
}

/// The key in a file by which its model starts at rest; empty if there is none.
std::string rest_of(const ModelFile& file) {
  if (file.analysis == ModelFile::Analysis::quasi_static)
    return "[solver] has analysis = \"quasi_static\"";
  return file.start == ModelFile::Start::equilibrium ? "[solver] has start = \"equilibrium\"" : "";
}

/// Replaces all initial values by the state of another run.
void restart(const StudyTable& root, ModelFile& file) {
  if (!root.has("restart")) return;
  if (!rest_of(file).empty())
    root.refuse("restart",
                rest_of(file) + ", but a restart continues a motion; remove one of them");
  if (file.linearised_at)
    root.refuse("restart",
                "a linearisation is made at time zero, a restart starts later; remove one of them");
  read_restart(root.table("restart"), file.model, file.warnings);
  if (!(file.model.start.time_s < file.end_time_s))
    root.refuse("restart", "expected a time before end_time of [solver]");
}

/// Completes the model across its tables; these messages name no line.
void assemble(Assembly& assembly, ModelFile& file) {
  try {
    multibody::check(assembly.model);
    check_connections(assembly);
    place_bodies(assembly.model, assembly.starts, assembly.posed);
    carry_bodies(assembly.model, assembly.starts, assembly.moving);
    check_starts(assembly, rest_of(file));
  } catch (const InputError& error) {
    throw InputError(file.file.string() + ": " + error.what());
  }
  file.has_expressions = assembly.has_expressions;
  file.model = std::move(assembly.model);
  file.relaxations = std::move(assembly.relaxations);
}

}  // namespace

std::span<const Key> model_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all = {
        variables_key(),
        assembly_key(),
        Key::table("solver", "Duration, initial state and time integration of the run",
                   kSolverKeys),
        Key::table("restart",
                   "Restart from the state at an output of another run, instead of the initial "
                   "states of the model",
                   kRestartKeys),
        Key::table("linearisation",
                   "Linearisation: frequencies, damping ratios and mode shapes of small motions, "
                   "in addition to the run",
                   kLinearisationKeys),
    };
    for (const ModelSection& section : model_sections()) all.push_back(section.key);
    all.push_back(Key::table("output", "Output of results", kOutputKeys));
    all.push_back(Key::tables("channel",
                              "Output channels for the table, the CSV file and the history "
                              "(default: all markers, joints, modes and energies)",
                              channel_keys()));
    return all;
  }();
  return keys;
}

ModelFile read_model_file(const DocumentSource& source, const std::vector<std::string>& settings) {
  const std::filesystem::path& path = source.path;
  const StudyDocument document(source, settings, model_keys());
  const FilesRead reads;
  const StudyTable root = document.root();
  ModelFile file;
  file.file = path;
  read_solver(root.table("solver"), file);
  read_linearisation(root, file);
  Assembly assembly;
  assembly.end_time_s = file.end_time_s;
  assembly.resolution_s = file.solver.resolution_s;
  assembly.model.gravity_m_s2 = file.model.gravity_m_s2;
  for (const ModelSection& section : model_sections())
    for (const StudyTable& table : root.tables(std::string(section.key.name)))
      section.read(table, assembly);
  if (assembly.model.bodies.empty())
    throw InputError(path.string() + ": expected bodies as tables [[body]], found none");
  assemble(assembly, file);
  read_output(root, file);
  restart(root, file);
  root.finish();
  file.files = document.files();
  const std::vector<InputFile> others = input_files(reads.files());
  file.files.insert(file.files.end(), others.begin(), others.end());
  file.parameters = document.parameters();
  const auto is_resolution = [](const Parameter& each) { return each.key == "solver.resolution"; };
  if (file.has_expressions && std::ranges::none_of(file.parameters, is_resolution))
    file.parameters.push_back(
        {"solver.resolution", exact_text(file.solver.resolution_s) + " s", Origin::synthetic,
         "resolution of expressions; default, since the file does not give it"});
  return file;
}

}  // namespace flexneck::pipeline
