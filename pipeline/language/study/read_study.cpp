// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/solver_steps.h"
#include "pipeline/language/study/fit_section.h"
#include "pipeline/language/study/sections.h"
#include "pipeline/language/study/study_reader.h"
#include "pipeline/language/study/sweep_section.h"

namespace flexneck::pipeline {

MeshOrders read_mesh_orders(const StudyTable& mesh) {
  MeshOrders orders;
  if (mesh.has("partitions")) {
    for (const double count : mesh.numbers("partitions")) {
      if (!(count >= 1 && count <= 4096 && count == std::floor(count))) {
        mesh.refuse("partitions",
                    "expected whole numbers of processes from 1 to 4096, such as [2, 4]");
      }
      orders.partitions.push_back(static_cast<int>(count));
    }
  }
  orders.node_order = mesh.choice("node_order") == 1;
  return orders;
}

void read_solver(const StudyTable& table, Study& study) {
  read_steps(table, study.solver);
  if (table.has("gravity")) study.gravity_m_s2 = quantity_vector(table, "gravity");
  table.finish();
}

namespace {

template <typename Section>
std::vector<Section> read_all(const StudyTable& root, const std::string& key,
                              Section (*read)(const StudyTable&)) {
  std::vector<Section> sections;
  for (const StudyTable& table : root.tables(key)) sections.push_back(read(table));
  check_names(names_of(sections), key);
  return sections;
}

void read_output(const StudyTable& table, Study& study) {
  study.output_interval_s = table.quantity("interval");
  if (table.has("verification") && table.file("verification").has_filename())
    study.verification = table.file("verification");
  table.finish();
}

/// Checks that concern several sections; these messages name no line.
void check_sections(const StudyTable& root, const Study& study) {
  if (study.neck() == nullptr) return;
  try {
    check_neck(root, *study.neck());
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
}

/// Checks the loads, which act on a mesh, and the prestress, which requires loads.
void check_loads(const StudyTable& root, const Study& study) {
  if (!study.loads.empty() && !study.structure)
    root.refuse("load", "has no effect without a mesh; add [geometry], or remove the loads");
  if (study.modes.prestress && study.loads.empty())
    root.table("modes").refuse("prestress",
                               "expected a [[load]] that causes the prestress, found none");
}

/// Refuses keys that have no effect with matrices, which have neither elements nor sets.
void refuse_keys_of_meshes(const StudyTable& root) {
  const std::string why = "has no effect with [matrices], which contain no mesh";
  root.refuse_given({"substructures"}, why);
  const StudyTable modes = root.table("modes");
  for (const std::string& key : modes.keys())
    if (key != "count" && key != "check" && key != "solver" && key != "petsc_options")
      modes.refuse_given({key}, why);
}

/// Checks that names used in one part of the study are defined in another.
void check_references(const Study& study) {
  const auto require = [&](const std::string& who, const std::vector<std::string>& names,
                           const std::string& name, const std::string& kind) {
    try {
      find_name(names, name, kind);
    } catch (const InputError& error) {
      throw InputError(study.file.string() + ": " + who + ": " + error.what());
    }
  };
  for (const CaseSection& experiment : study.cases)
    if (experiment.kind == CaseSection::Kind::pendulum)
      require("case." + experiment.name, names_of(study.pulses), experiment.pulse, "pulse");
  const std::vector<std::string> interfaces = names_of(study.interfaces);
  for (const std::string& name : study.modes.rigid_interfaces)
    require("modes.rigid_interfaces", interfaces, name, "interface");
  for (const std::string& name : study.modes.basis_interfaces)
    require("modes.basis_interfaces", interfaces, name, "interface");
  if (study.modes.attached_body.empty()) return;
  if (!study.modes.attached_to.empty())
    require("modes.attached_to", interfaces, study.modes.attached_to, "interface");
  try {
    study.rigid_body(study.modes.attached_body);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": modes.attached_body: " + error.what());
  }
}

/// Reads bodies, joints and forces, and the cases that use them.
void read_experiments(const StudyTable& root, CasesRead which, Study& study) {
  const FilesRead reads;
  study.pulses = read_all(root, "pulse", read_pulse);
  const StudyModels models(root, names_of(study.interfaces));
  study.cases = read_cases(root, models, which);
  check_names(names_of(study.cases), "case");
  double longest_s = 0;
  for (const CaseSection& experiment : study.cases)
    longest_s = std::max(longest_s, experiment.duration_s);
  study.model = models.whole(longest_s > 0 ? longest_s : 1, study.solver.resolution_s);
  study.tables = input_files(reads.files());
}

void read_all_tests(const StudyTable& root, const std::vector<TestSection>& known, CasesRead which,
                    Study& study) {
  const FilesRead reads;
  read_tests(root, known, which, study);
  study.rules = input_files(reads.files());
  select_cases(root, study);
}

}  // namespace

const MaterialModels& Study::material_models() const {
  static const MaterialModels none;
  return structure ? structure->material_models : none;
}

const NeckSection* Study::neck() const {
  return structure && structure->neck ? &*structure->neck : nullptr;
}

bool Study::has_static_moduli() const {
  const MaterialModels& models = material_models();
  return std::any_of(models.begin(), models.end(),
                     [](const auto& entry) { return entry.second.static_modulus_ratio != 1; });
}

const multibody::RigidBody& Study::rigid_body(const std::string& name) const {
  const std::vector<multibody::Body>& bodies = model.model.bodies;
  const multibody::Body& body = bodies[find_name(names_of(bodies), name, "body")];
  const auto* const rigid = std::get_if<multibody::RigidBody>(&body.kind);
  if (rigid == nullptr)
    throw InputError("expected a rigid body, found '" + name + "', which is not rigid");
  return *rigid;
}

namespace {

/// Reads a study from its document.
/// @param known  tests of an earlier reading
Study study_of(const StudyDocument& document, const std::filesystem::path& path,
               const std::vector<std::string>& settings, CasesRead which = CasesRead::all,
               const std::vector<TestSection>& known = {}) {
  const StudyTable root = document.root();
  Study study;
  study.file = path;
  study.settings = settings;
  const StudyTable mesh = root.table("mesh");
  study.mesh_orders = read_mesh_orders(mesh);
  if (root.has("geometry")) study.structure = read_structure(root.table("geometry"), mesh);
  if (!root.has("geometry")) root.refuse_given({"mesh"}, "has no effect without [geometry]");
  if (root.has("matrices")) {
    if (root.has("geometry")) {
      root.refuse("matrices", "expected [geometry] or [matrices], not both");
    }
    study.matrices = read_matrices(root.table("matrices"));
    refuse_keys_of_meshes(root);
  }
  study.modes = read_modes(root.table("modes"));
  study.substructures = read_substructures(root.table("substructures"));
  study.interfaces = read_all(root, "interface", read_interface);
  study.loads = read_all(root, "load", read_load);
  check_loads(root, study);
  read_experiments(root, which, study);
  read_all_tests(root, known, which, study);
  read_solver(root.table("solver"), study);
  read_output(root.table("output"), study);
  // Read to check for errors.
  if (root.has("sweep")) read_sweep(root.table("sweep"));
  if (root.has("fit")) {
    const FilesRead reads;
    read_fit(root.table("fit"));
    const std::vector<InputFile> targets = input_files(reads.files());
    study.tables.insert(study.tables.end(), targets.begin(), targets.end());
  }
  root.finish();
  check_sections(root, study);
  check_references(study);
  study.files = document.files();
  study.parameters = document.parameters();
  study.defaults = document.defaults();
  if (study.neck() != nullptr)
    forget_fit_of_changed_neck(root, study.parameters, *study.structure->neck);
  return study;
}

/// True if a setting affects others, or is made of variables.
bool concerns_variables(const std::string& setting) {
  return setting.starts_with("variables.") || setting.starts_with("assembly.") ||
         setting.find('$') != std::string::npos;
}

std::vector<std::string> keys_of(const std::vector<std::string>& settings) {
  std::vector<std::string> keys;
  keys.reserve(settings.size());
  for (const std::string& setting : settings) keys.push_back(setting.substr(0, setting.find('=')));
  return keys;
}

}  // namespace

Study read_study(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  return study_of(StudyDocument(path, settings, study_keys()), path, settings);
}

StudyReader::StudyReader(std::filesystem::path path, std::vector<std::string> settings)
    : path_(std::move(path)), settings_(std::move(settings)) {}

Study StudyReader::read(const std::vector<std::string>& more) {
  std::vector<std::string> all = settings_;
  all.insert(all.end(), more.begin(), more.end());
  std::vector<std::string> keys = keys_of(more);
  if (!document_ || keys != keys_ || std::ranges::any_of(more, concerns_variables)) {
    FilesRead reads;
    document_.emplace(path_, all, study_keys());
    reads.forget();  // the values identify the study
    keys_ = std::move(keys);
  } else {
    for (const std::string& setting : more) document_->set(setting);
  }
  Study study = study_of(*document_, path_, all, CasesRead::chosen, tests_);
  if (tests_.empty()) tests_ = study.tests;
  return study;
}

std::filesystem::path built_in_study() {
  return shipped_file("pipeline/data/studies/hybrid3.toml");
}

std::filesystem::path built_in_qualification() {
  return built_in_study().replace_filename("hybrid3_qualification.toml");
}

}  // namespace flexneck::pipeline
