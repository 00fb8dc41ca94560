// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/model_file.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/channel_section.h"
#include "pipeline/model/model_check.h"
#include "pipeline/model/model_sections.h"
#include "pipeline/model/solver_steps.h"
#include "pipeline/model/start_check.h"

namespace flexneck::pipeline {

namespace {

using Read = void (*)(const StudyTable&, Assembly&);

/// In the order in which one kind of table may name things of another.
constexpr std::pair<const char*, Read> kSections[] = {
    {"body", read_body},
    {"marker", read_marker},
    {"joint", read_joint},
    {"motor", read_motor},
    {"force", read_force},
    {"torque", read_torque},
    {"spring", read_spring},
    {"bushing", read_bushing},
    {"resistance", read_resistance},
    {"line_force", read_line_force},
};

void read_solver(const StudyTable& table, ModelFile& file) {
  read_steps(table, file.solver);
  file.solver.max_steps = table.count_or("most_steps", 1, file.solver.max_steps);
  if (table.has("formulation"))
    file.solver.formulation = static_cast<multibody::Formulation>(
        choice(table, "formulation", {"descriptor", "recursive", "automatic"}));
  if (table.has("integrator"))
    file.solver.integrator = static_cast<multibody::Integrator>(
        choice(table, "integrator", {"dormand_prince", "generalised_alpha"}));
  file.solver.spectral_radius = table.number_or("spectral_radius", file.solver.spectral_radius);
  if (table.has("analysis"))
    file.analysis =
        static_cast<ModelFile::Analysis>(choice(table, "analysis", {"motion", "quasi_static"}));
  if (table.has("start") && file.analysis == ModelFile::Analysis::quasi_static)
    table.refuse("start", "a quasi-static analysis is at rest all the time; leave this key out");
  if (table.has("start"))
    file.start = static_cast<ModelFile::Start>(choice(table, "start", {"given", "equilibrium"}));
  if (table.has("gravity")) file.model.gravity_m_s2 = quantity_vector(table, "gravity", "m/s^2");
  file.end_time_s = table.quantity("end_time", "s");
  if (!(file.end_time_s > 0)) table.refuse("end_time", "expected a positive time");
  table.finish();
}

void read_linearisation(const StudyTable& root, ModelFile& file) {
  if (!root.has("linearisation")) return;
  const StudyTable table = root.table("linearisation");
  file.linearised_at =
      static_cast<multibody::LinearisedAt>(choice(table, "about", {"equilibrium", "given"}));
  if (table.has("rates")) {
    file.rates_rad_s = table.quantities("rates", "rad/s", 0);
    if (file.linearised_at != multibody::LinearisedAt::equilibrium)
      table.refuse("rates", "a Campbell diagram is about steady rotation: about = \"equilibrium\"");
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
  output.interval_s = table.quantity_or("interval", "s", output.interval_s);
  if (!(output.interval_s > 0)) table.refuse("interval", "expected a positive time");
  output.markers = chosen(table, "markers", names_of(file.model.markers), "marker");
  output.joints = chosen(table, "joints", names_of(file.model.joints), "joint");
  table.finish();
  for (const StudyTable& channel : root.tables("channel"))
    output.channels.push_back(read_channel(channel, file.model, output.interval_s));
  check_names(names_of(output.channels), "channel");
}

/// What concerns more than one table; these messages name no line.
void assemble(Assembly& assembly, ModelFile& file) {
  try {
    multibody::check(assembly.model);
    check_connections(assembly);
    place_bodies(assembly.model, assembly.starts, assembly.posed);
    carry_bodies(assembly.model, assembly.starts, assembly.moving);
    check_starts(assembly, file.start, file.analysis);
  } catch (const InputError& error) {
    throw InputError(file.file.string() + ": " + error.what());
  }
  file.model = std::move(assembly.model);
}

}  // namespace

ModelFile read_model_file(const std::filesystem::path& path,
                          const std::vector<std::string>& settings) {
  const StudyDocument document(path, settings);
  const StudyTable root = document.root();
  ModelFile file;
  file.file = path;
  read_solver(root.table("solver"), file);
  read_linearisation(root, file);
  Assembly assembly;
  assembly.end_time_s = file.end_time_s;
  assembly.model.gravity_m_s2 = file.model.gravity_m_s2;
  for (const auto& [key, read] : kSections)
    for (const StudyTable& table : root.tables(key)) read(table, assembly);
  if (assembly.model.bodies.empty())
    throw InputError(path.string() + ": expected bodies as tables [[body]], found none");
  assemble(assembly, file);
  read_output(root, file);
  root.finish();
  file.files = document.files();
  file.files.insert(file.files.end(), assembly.files.begin(), assembly.files.end());
  file.parameters = document.parameters();
  return file;
}

}  // namespace flexneck::pipeline
