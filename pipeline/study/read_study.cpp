// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/document/assemblies.h"
#include "pipeline/document/shipped_files.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/model_sections.h"
#include "pipeline/model/solver_steps.h"
#include "pipeline/study/fit_section.h"
#include "pipeline/study/sections.h"
#include "pipeline/study/study_reader.h"
#include "pipeline/study/sweep_section.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> stiffenings() { return {"none", "unit-loads"}; }
std::vector<std::string> prestresses() { return {"none", "loads"}; }
std::vector<std::string> solvers() { return {"direct", "iterative"}; }

constexpr Key kFixedKeys[] = {
    Key::text("*", kNone,
              "Directions, such as \"x\" or \"yz\", that the node set of this name is fixed in"),
};

constexpr Key kModesKeys[] = {
    Key::count("count", "10", "Number of elastic modes", {.range = at_least(1)}),
    Key::text("formulation", "mixed_pressure",
              "Formulation of the elements: mixed_pressure, displacement or reduced"),
    Key::flag("certify", "false",
              "Whether to prove that no mode is missing, and to estimate the error of the mesh",
              {.changes_results = false}),
    Key::text("basis", "normal", "Which vectors the basis of a body is made of",
              {.choices = [] { return fe_modal::basis_names(); }}),
    Key::texts("rigid_interfaces", kNone, "Interfaces whose nodes move as a rigid body"),
    Key::texts("basis_interfaces", kNone,
               "Interfaces whose static shapes join the basis; all if the key is not there"),
    Key::text("stress_stiffening", "none",
              "Geometric stiffness of the modes under unit loads at the interfaces",
              {.choices = stiffenings}),
    Key::text("prestress", "none",
              "Stresses that the modes are about: none, or those of a linear static step under all "
              "[[load]]",
              {.choices = prestresses}),
    Key::text("solver", "direct", "How the eigenproblem is solved",
              {.choices = solvers, .changes_results = false}),
    Key::texts("fixed", kNone, "Node sets that are fixed in all directions", {.formerly = "held"}),
    Key::table("fixed_directions", "Node sets that are fixed in some directions", kFixedKeys,
               UsedBy::table, "held_directions"),
    Key::flag("deck_supports", "true",
              "Whether supports hold that the structure's file gives, such as *BOUNDARY and SPC1"),
    Key::texts("rigid_parts", kNone, "Parts whose motion gives the modes their names"),
    Key::text("attached_body", kNone,
              "Rigid body attached to an interface for the loaded frequencies"),
    Key::text("attached_to", kNone, "That interface; the first if the key is not there"),
};

constexpr auto kSolverKeys = joined(
    std::to_array<Key>({
        Key::quantities("gravity", "m/s^2", kNone,
                        "Gravity of pendulum cases, in the world; 1 gn down if it is not there",
                        {.size = 3}),
    }),
    kStepKeys);

constexpr Key kOutputKeys[] = {
    Key::quantity("interval", "s", "0.001", "Time between outputs", {.range = kPositive}),
    Key::file("verification", kNone,
              "Table of published figures that results are compared with; \"\" for none"),
};

}  // namespace

std::vector<Key> model_table_keys() {
  std::vector<Key> keys;
  for (const ModelSection& section : model_sections()) keys.push_back(section.key);
  return keys;
}

namespace {

/// Of the study itself: bodies and what joins them belong to all cases, forces to those that say
/// so.
std::vector<Key> shared_model_keys() {
  std::vector<Key> keys = model_table_keys();
  const std::size_t forces = force_sections().size();
  for (std::size_t k = 0; k < keys.size(); ++k)
    keys[k].details.used_by =
        k + forces < keys.size() ? UsedBy::all_experiments : UsedBy::named_experiments;
  return keys;
}

std::span<const Key> modes_keys() {
  static const std::vector<Key> kKeys = [] {
    std::vector<Key> keys(std::begin(kModesKeys), std::end(kModesKeys));
    keys.insert(keys.end(), modes_connection_keys().begin(), modes_connection_keys().end());
    return keys;
  }();
  return kKeys;
}

std::vector<Key> all_study_keys() {
  std::vector<Key> keys = {
      variables_key(),
      assembly_key(),
      Key::table("geometry", "What is meshed", geometry_keys(), UsedBy::mesh),
      Key::table("mesh", "How it is meshed", mesh_keys(), UsedBy::mesh),
      Key::table("matrices", "Matrices of another program, in place of a mesh", matrices_keys(),
                 UsedBy::modes),
      Key::table("modes", "Modes of the structure", modes_keys(), UsedBy::modes),
      Key::table("substructures", "Bodies that the structure is cut into", substructures_keys(),
                 UsedBy::modes),
      Key::tables("interface", "Where other bodies attach to a structure", interface_keys(),
                  UsedBy::modes),
      Key::tables("load", "Loads of a linear static step: 'flexneck stress', modes.prestress",
                  load_keys(), UsedBy::modes),
  };
  const std::vector<Key> shared = shared_model_keys();
  keys.insert(keys.end(), shared.begin(), shared.end());
  const std::vector<Key> experiments = {
      Key::tables("pulse", "Decelerations of the pendulum's arm", pulse_keys(),
                  UsedBy::named_experiments),
      Key::table("pendulum", "Keys that all [[case]] of the pendulum share", case_keys(),
                 UsedBy::named_experiments),
      Key::table("static", "Keys that all [[case]] of the static tester share", case_keys(),
                 UsedBy::named_experiments),
      Key::tables("case", "Experiments", case_keys(), UsedBy::named_experiments),
      Key::texts("cases", kNone,
                 "Names of the cases that are run, which may end in *; a variant brings the case "
                 "that it is made of; all if the key is not there"),
      Key::tables("variant", "Experiments made of others, with keys of their own", variant_keys(),
                  UsedBy::named_experiments),
      Key::table("dummy", "Whose head and neck the bodies are", dummy_keys(),
                 UsedBy::named_experiments),
      Key::tables("test", "Cases that are judged by tests of regulations", test_keys(),
                  UsedBy::named_experiments),
      Key::table("solver", "Integration of the experiments", kSolverKeys, UsedBy::all_experiments),
      Key::table("output", "What is written", kOutputKeys, UsedBy::all_experiments),
      Key::table("sweep", "Many values of some keys, and what becomes of them: 'flexneck sweep'",
                 sweep_keys(), UsedBy::named_experiments),
      Key::table("fit", "Free values of some keys that bring results to targets: 'flexneck fit'",
                 fit_keys(), UsedBy::named_experiments),
  };
  keys.insert(keys.end(), experiments.begin(), experiments.end());
  return keys;
}

}  // namespace

std::span<const Key> study_keys() {
  static const std::vector<Key> kKeys = all_study_keys();
  return kKeys;
}

fe_modal::Formulation read_formulation(const StudyTable& table) {
  try {
    return fe_modal::formulation_from(table.text("formulation"));
  } catch (const InputError& error) {
    table.refuse("formulation", error.what());
  }
}

MeshOrders read_mesh_orders(const StudyTable& mesh) {
  MeshOrders orders;
  if (mesh.has("partitions")) {
    for (const double count : mesh.numbers("partitions")) {
      if (!(count >= 1 && count <= 4096 && count == std::floor(count))) {
        mesh.refuse("partitions", "expected numbers of processes, such as [2, 4]");
      }
      orders.partitions.push_back(static_cast<int>(count));
    }
  }
  orders.node_order = mesh.choice("node_order") == 1;
  return orders;
}

namespace {

/// left = "x", bottom = "yz"
std::map<std::string, std::array<bool, 3>> read_fixed_directions(const StudyTable& table) {
  std::map<std::string, std::array<bool, 3>> fixed;
  for (const std::string& set : table.keys()) {
    const std::string letters = table.text(set);
    if (letters.empty() || letters.find_first_not_of("xyz") != std::string::npos) {
      table.refuse(set, "expected directions such as \"x\" or \"yz\", found \"" + letters + "\"");
    }
    for (const char letter : letters) fixed[set][static_cast<std::size_t>(letter - 'x')] = true;
  }
  table.finish();
  return fixed;
}

}  // namespace

ModesSection read_modes(const StudyTable& table) {
  ModesSection modes;
  modes.count = table.count("count");
  modes.formulation = read_formulation(table);
  modes.certify = table.flag("certify");
  modes.basis = static_cast<fe_modal::BasisKind>(table.choice("basis"));
  modes.rigid_interfaces = table.texts("rigid_interfaces");
  modes.basis_interfaces = table.texts("basis_interfaces");
  modes.stress_stiffening = table.choice("stress_stiffening") == 1;
  modes.prestress = table.choice("prestress") == 1;
  modes.solver =
      table.choice("solver") == 0 ? fe_modal::Solver::direct : fe_modal::Solver::iterative;
  modes.fixed = table.texts("fixed");
  modes.fixed_directions = read_fixed_directions(table.table("fixed_directions"));
  modes.deck_supports = table.flag("deck_supports");
  modes.connections = read_modes_connections(table);
  modes.rigid_parts = table.texts("rigid_parts");
  modes.attached_body = table.text("attached_body");
  modes.attached_to = table.text("attached_to");
  table.finish();
  return modes;
}

void read_solver(const StudyTable& table, Study& study) {
  read_steps(table, study.solver);
  if (table.has("gravity")) study.gravity_m_s2 = quantity_vector(table, "gravity");
  table.finish();
}

namespace {

template <typename Section, typename... More>
std::vector<Section> read_all(const StudyTable& root, const std::string& key,
                              Section (*read)(const StudyTable&, More...),
                              std::type_identity_t<More>... more) {
  std::vector<Section> sections;
  for (const StudyTable& table : root.tables(key)) sections.push_back(read(table, more...));
  check_names(names_of(sections), key);
  return sections;
}

void read_output(const StudyTable& table, Study& study) {
  study.output_interval_s = table.quantity("interval");
  if (table.has("verification") && table.file("verification").has_filename())
    study.verification = table.file("verification");
  table.finish();
}

/// What concerns several sections; these messages name no line.
void check_sections(const StudyTable& root, const Study& study) {
  if (study.neck() == nullptr) return;
  try {
    check_neck(root, *study.neck());
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
}

/// Loads act on a mesh, and a prestress is of loads.
void check_loads(const StudyTable& root, const Study& study) {
  if (!study.loads.empty() && !study.structure)
    root.refuse("load", "acts on a mesh, but there is no [geometry]");
  if (study.modes.prestress && study.loads.empty())
    root.table("modes").refuse("prestress", "there is no [[load]]");
}

/// Names that one part of the study uses and another must define.
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
  if (study.modes.attached_body.empty()) return;
  try {
    study.rigid_body(study.modes.attached_body);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": modes.attached_body: " + error.what());
  }
}

void add_file(std::vector<InputFile>& files, const InputFile& file) {
  const auto is_same = [&](const InputFile& other) {
    return other.name == file.name && other.hash == file.hash;
  };
  if (std::none_of(files.begin(), files.end(), is_same)) files.push_back(file);
}

/// Bodies, joints and forces, and the cases that are made of them.
void read_experiments(const StudyTable& root, const std::vector<TestSection>& known, Study& study) {
  study.pulses = read_all(root, "pulse", read_pulse, study.tables);
  const StudyModels models(root, names_of(study.interfaces));
  study.cases = read_cases(root, models);
  check_names(names_of(study.cases), "case");
  double longest_s = 0;
  for (const CaseSection& experiment : study.cases) {
    longest_s = std::max(longest_s, experiment.duration_s);
    for (const InputFile& file : experiment.model.files) add_file(study.tables, file);
  }
  study.model = models.whole(longest_s > 0 ? longest_s : 1);
  for (const InputFile& file : study.model.files) add_file(study.tables, file);
  read_tests(root, known, study);
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
    throw InputError("expected a rigid body, found '" + name + "', which is not");
  return *rigid;
}

namespace {

/// @param known  tests of an earlier reading
Study study_of(const StudyDocument& document, const std::filesystem::path& path,
               const std::vector<std::string>& settings,
               const std::vector<TestSection>& known = {}) {
  const StudyTable root = document.root();
  Study study;
  study.file = path;
  study.settings = settings;
  const StudyTable mesh = root.table("mesh");
  study.mesh_orders = read_mesh_orders(mesh);
  if (root.has("geometry")) study.structure = read_structure(root.table("geometry"), mesh);
  if (root.has("matrices")) {
    if (root.has("geometry")) {
      root.refuse("matrices", "expected [geometry] or [matrices], not both");
    }
    study.matrices = read_matrices(root.table("matrices"));
  }
  study.modes = read_modes(root.table("modes"));
  study.substructures = read_substructures(root.table("substructures"));
  study.interfaces = read_all(root, "interface", read_interface);
  study.loads = read_all(root, "load", read_load);
  check_loads(root, study);
  read_experiments(root, known, study);
  read_solver(root.table("solver"), study);
  read_output(root.table("output"), study);
  // For what is wrong with them.
  if (root.has("sweep")) read_sweep(root.table("sweep"));
  if (root.has("fit")) read_fit(root.table("fit"), study.tables);
  root.finish();
  check_sections(root, study);
  check_references(study);
  study.files = document.files();
  study.parameters = document.parameters();
  study.defaults = document.defaults();
  study.warnings = document.warnings();
  if (study.neck() != nullptr)
    forget_fit_of_changed_neck(root, study.parameters, *study.structure->neck);
  return study;
}

/// Whether a setting takes part in others, or is made of variables.
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
  if (std::any_of(more.begin(), more.end(), concerns_variables)) return read_study(path_, all);
  std::vector<std::string> keys = keys_of(more);
  if (!document_ || keys != keys_) {
    document_.emplace(path_, all, study_keys());
    keys_ = std::move(keys);
    tests_.clear();
  } else {
    for (const std::string& setting : more) document_->set(setting);
  }
  Study study = study_of(*document_, path_, all, tests_);
  if (tests_.empty()) tests_ = study.tests;
  return study;
}

std::filesystem::path built_in_study() { return shipped_file("pipeline/studies/hybrid3.toml"); }

std::filesystem::path built_in_qualification() {
  return built_in_study().replace_filename("hybrid3_qualification.toml");
}

}  // namespace flexneck::pipeline
