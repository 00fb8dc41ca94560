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
#include "pipeline/document/table_values.h"
#include "pipeline/model/solver_steps.h"
#include "pipeline/study/sections.h"
#include "pipeline/study/study_reader.h"
#include "pipeline/study/sweep_section.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> stiffenings() { return {"none", "unit-loads"}; }
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
    Key::text("solver", "direct", "How the eigenproblem is solved",
              {.choices = solvers, .changes_results = false}),
    Key::texts("fixed", kNone, "Node sets that are fixed in all directions", {.formerly = "held"}),
    Key::table("fixed_directions", "Node sets that are fixed in some directions", kFixedKeys,
               UsedBy::table, "held_directions"),
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
    Key::file("verification", kNone, "Table of published figures that results are compared with"),
};

}  // namespace

std::span<const Key> study_keys() {
  static const std::array kKeys = std::to_array<Key>({
      variables_key(),
      assembly_key(),
      Key::table("geometry", "What is meshed", geometry_keys(), UsedBy::mesh),
      Key::table("mesh", "How it is meshed", mesh_keys(), UsedBy::mesh),
      Key::table("matrices", "Matrices of another program, in place of a mesh", matrices_keys(),
                 UsedBy::modes),
      Key::table("modes", "Modes of the structure", kModesKeys, UsedBy::modes),
      Key::table("substructures", "Bodies that the structure is cut into", substructures_keys(),
                 UsedBy::modes),
      Key::tables("interface", "Where other bodies attach to a structure", interface_keys(),
                  UsedBy::modes),
      Key::tables("body", "Bodies of the experiments", body_keys(), UsedBy::all_experiments),
      Key::tables("marker", "Points of bodies; interfaces of deformable ones are markers",
                  marker_keys(), UsedBy::all_experiments),
      Key::tables("joint", "Joints between markers", joint_keys(), UsedBy::all_experiments),
      Key::tables("force", "Forces of static tests", force_keys(), UsedBy::named_experiments),
      Key::tables("pulse", "Decelerations of the pendulum's arm", pulse_keys(),
                  UsedBy::named_experiments),
      Key::tables("rigid_neck", "Necks that are rigid links between two pivots", rigid_neck_keys(),
                  UsedBy::named_experiments),
      Key::tables("head_spring", "Nodding blocks and cable as a pin of the head",
                  head_spring_keys(), UsedBy::named_experiments),
      Key::table("pendulum", "Keys that all [[case]] of the pendulum share", case_keys(),
                 UsedBy::named_experiments),
      Key::table("static", "Keys that all [[case]] of the static tester share", case_keys(),
                 UsedBy::named_experiments),
      Key::tables("case", "Experiments", case_keys(), UsedBy::named_experiments),
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
  });
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
  modes.solver =
      table.choice("solver") == 0 ? fe_modal::Solver::direct : fe_modal::Solver::iterative;
  modes.fixed = table.texts("fixed");
  modes.fixed_directions = read_fixed_directions(table.table("fixed_directions"));
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
  if (table.has("verification")) study.verification = table.file("verification");
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
  const std::vector<std::string> bodies = names_of(study.bodies);
  for (const MarkerSection& marker : study.markers) {
    require("marker." + marker.name, bodies, marker.body, "body");
  }
  for (const CaseSection& experiment : study.cases) {
    const std::string who = "case." + experiment.name;
    for (const std::string& body : experiment.bodies) require(who, bodies, body, "body");
    for (const std::string& force : experiment.forces) {
      require(who, names_of(study.forces), force, "force");
    }
    if (experiment.kind != CaseSection::Kind::pendulum) continue;
    require(who, names_of(study.pulses), experiment.pulse, "pulse");
    if (!experiment.rigid_neck.empty())
      require(who, names_of(study.rigid_necks), experiment.rigid_neck, "rigid_neck");
    if (!experiment.head_spring.empty())
      require(who, names_of(study.head_springs), experiment.head_spring, "head_spring");
  }
  if (!study.modes.attached_body.empty()) {
    require("modes.attached_body", bodies, study.modes.attached_body, "body");
    if (study.body(study.modes.attached_body).kind != BodySection::Kind::rigid) {
      throw InputError(study.file.string() +
                       ": modes.attached_body: expected a rigid body, found '" +
                       study.modes.attached_body + "', which is not");
    }
  }
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

const BodySection& Study::body(const std::string& name) const {
  return bodies[find_name(names_of(bodies), name, "body")];
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
  study.bodies = read_all(root, "body", read_body);
  study.markers = read_all(root, "marker", read_marker);
  study.joints = read_all(root, "joint", read_joint);
  study.forces = read_all(root, "force", read_force);
  study.pulses = read_all(root, "pulse", read_pulse, study.tables);
  study.rigid_necks = read_all(root, "rigid_neck", read_rigid_neck, study.tables);
  study.head_springs = read_all(root, "head_spring", read_head_spring, study.tables);
  study.cases = read_cases(root);
  check_names(names_of(study.cases), "case");
  read_tests(root, known, study);
  read_solver(root.table("solver"), study);
  read_output(root.table("output"), study);
  if (root.has("sweep")) read_sweep(root.table("sweep"));  // for what is wrong with it
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

std::filesystem::path built_in_study() {
  return std::filesystem::path(FLEXNECK_DATA_DIR) / "pipeline/studies/hybrid3.toml";
}

}  // namespace flexneck::pipeline
