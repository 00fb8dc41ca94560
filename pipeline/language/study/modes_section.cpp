// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/error.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> stiffenings() { return {"none", "unit-loads"}; }
std::vector<std::string> prestresses() { return {"none", "loads"}; }

constexpr Key kFixedKeys[] = {
    Key::text("*", kNone,
              "Directions, such as \"x\" or \"yz\", in which the node set with this name is fixed"),
};

constexpr Key kModesKeys[] = {
    Key::count("count", "10", "Number of elastic modes", {.range = at_least(1)}),
    Key::text("formulation", "mixed_pressure",
              "Element formulation: mixed_pressure, displacement or reduced"),
    Key::flag("check", "false",
              "Check that no mode is missing, and estimate the discretisation error",
              {.changes_results = false}),
    Key::text("basis", "normal",
              "Kind of basis: normal modes only, with residual vectors, Craig-Bampton, or with "
              "inertia relief",
              {.choices = [] { return fe_modal::basis_names(); }}),
    Key::texts("rigid_interfaces", kNone, "Interfaces whose nodes are rigidly coupled"),
    Key::texts("basis_interfaces", kNone,
               "Interfaces whose static shapes are added to the basis (default: all)"),
    Key::text("stress_stiffening", "none",
              "Compute the geometric stiffness of the modes under unit loads at the interfaces",
              {.choices = stiffenings}),
    Key::text("slits", "cracks",
              "Model of open slits: cracks without contact; openings, which open and close and do "
              "not slide while closed; or openings whose sides slide without friction",
              {.choices = [] { return fe_modal::slit_motion_names(); }}),
    Key::text(
        "prestress", "none",
        "Prestress of the modes: none, or the stresses of a linear static step under all [[load]]",
        {.choices = prestresses}),
    Key::text("solver", "automatic",
              "Linear solver that factorises the stiffness: automatic means cholmod on one process "
              "and mumps on several MPI ranks",
              {.choices = [] { return fe_modal::solver_names(); }, .changes_results = false}),
    Key::text("petsc_options", kNone,
              "Solver options of PETSc and SLEPc, such as \"-eps_ncv 40 -st_mat_mumps_icntl_14 "
              "50\"; allowed are names that begin with -eps_ncv, -eps_mpd, -eps_max_it, -st_ksp_, "
              "-st_pc_factor_mat_, -st_mat_mumps_ or -st_mat_cholmod_",
              {.changes_results = false}),
    Key::texts("fixed", kNone, "Node sets that are fixed in all directions"),
    Key::table("fixed_directions", "Node sets that are fixed in some directions", kFixedKeys),
    Key::flag("deck_supports", "true",
              "Apply the supports in the geometry file, such as *BOUNDARY and SPC1"),
    Key::texts("rigid_parts", kNone, "Rigid parts whose motion determines the names of the modes"),
    Key::text("attached_body", kNone,
              "Rigid body that is attached to an interface to compute system frequencies"),
    Key::text("attached_to", kNone,
              "Interface to which that body is attached (default: the first)"),
};

/// Reads directions in which sets are fixed, such as left = "x", bottom = "yz".
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

std::span<const Key> modes_keys() {
  static const std::vector<Key> kKeys = [] {
    std::vector<Key> keys(std::begin(kModesKeys), std::end(kModesKeys));
    keys.insert(keys.end(), modes_connection_keys().begin(), modes_connection_keys().end());
    return keys;
  }();
  return kKeys;
}

fe_modal::Formulation read_formulation(const StudyTable& table) {
  try {
    return fe_modal::formulation_from(table.text("formulation"));
  } catch (const InputError& error) {
    table.refuse("formulation", error.what());
  }
}

ModesSection read_modes(const StudyTable& table) {
  ModesSection modes;
  modes.count = table.count("count");
  modes.formulation = read_formulation(table);
  modes.check = table.flag("check");
  modes.basis = static_cast<fe_modal::BasisKind>(table.choice("basis"));
  modes.rigid_interfaces = table.texts("rigid_interfaces");
  modes.basis_interfaces = table.texts("basis_interfaces");
  modes.stress_stiffening = table.choice("stress_stiffening") == 1;
  modes.slit_motions = static_cast<fe_modal::SlitMotions>(table.choice("slits"));
  modes.prestress = table.choice("prestress") == 1;
  modes.solver = static_cast<fe_modal::Solver>(table.choice("solver"));
  modes.petsc_options = table.text("petsc_options");
  modes.fixed = table.texts("fixed");
  modes.fixed_directions = read_fixed_directions(table.table("fixed_directions"));
  modes.deck_supports = table.flag("deck_supports");
  modes.connections = read_modes_connections(table);
  modes.rigid_parts = table.texts("rigid_parts");
  modes.attached_body = table.text("attached_body");
  modes.attached_to = table.text("attached_to");
  if (modes.attached_body.empty())
    table.refuse_given({"attached_to"}, "has no effect without attached_body");
  if (modes.basis == fe_modal::BasisKind::normal)
    table.refuse_given({"basis_interfaces"},
                       "has no effect with basis = \"normal\", which has no static shapes");
  table.finish();
  return modes;
}

}  // namespace flexneck::pipeline
