// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <vector>

#include "pipeline/language/document/assemblies.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/solver_steps.h"
#include "pipeline/language/study/fit_section.h"
#include "pipeline/language/study/sections.h"
#include "pipeline/language/study/study.h"
#include "pipeline/language/study/sweep_section.h"

namespace flexneck::pipeline {

namespace {

constexpr auto kSolverKeys = joined(
    std::to_array<Key>({
        Key::quantities("gravity", "m/s^2", kNone,
                        "Gravity of pendulum cases, in the world frame (default: 1 gn downwards)",
                        {.size = 3}),
    }),
    kStepKeys);

constexpr Key kOutputKeys[] = {
    Key::quantity("interval", "s", "0.001", "Output interval", {.range = kPositive}),
    Key::file("verification", kNone,
              "File with the published figures that results are compared with; \"\" for none"),
};

}  // namespace

std::vector<Key> model_table_keys() {
  std::vector<Key> keys;
  for (const ModelSection& section : model_sections()) keys.push_back(section.key);
  return keys;
}

namespace {

/// Keys of the study's own bodies, joints and forces: bodies and their connections are used by all
/// cases, forces by those that name them.
std::vector<Key> shared_model_keys() {
  std::vector<Key> keys = model_table_keys();
  const std::size_t forces = force_sections().size();
  for (std::size_t k = 0; k < keys.size(); ++k)
    keys[k].details.used_by =
        k + forces < keys.size() ? UsedBy::all_experiments : UsedBy::named_experiments;
  return keys;
}

std::vector<Key> all_study_keys() {
  std::vector<Key> keys = {
      variables_key(),
      assembly_key(),
      Key::table("geometry", "Geometry of the structure", geometry_keys(), UsedBy::mesh),
      Key::table("mesh", "Mesh of the structure", mesh_keys(), UsedBy::mesh),
      Key::table(
          "matrices",
          "Stiffness and mass matrices from another program, instead of a geometry and a mesh",
          matrices_keys(), UsedBy::modes),
      Key::table("modes", "Modes of the structure", modes_keys(), UsedBy::modes),
      Key::table("substructures", "Substructures into which the structure is divided",
                 substructures_keys(), UsedBy::modes),
      Key::tables("interface", "Interfaces at which other bodies are attached to the structure",
                  interface_keys(), UsedBy::modes),
      Key::tables("load",
                  "Loads of a linear static step, for 'flexneck stress' and modes.prestress",
                  load_keys(), UsedBy::modes),
  };
  const std::vector<Key> shared = shared_model_keys();
  keys.insert(keys.end(), shared.begin(), shared.end());
  const std::vector<Key> experiments = {
      Key::tables("pulse", "Deceleration pulses of the pendulum arm", pulse_keys(),
                  UsedBy::named_experiments),
      Key::table("pendulum", "Values shared by all [[case]] of the pendulum", case_keys(),
                 UsedBy::named_experiments),
      Key::table("static", "Values shared by all [[case]] of the static neck tester", case_keys(),
                 UsedBy::named_experiments),
      Key::tables("case", "Experiments", case_keys(), UsedBy::named_experiments),
      Key::texts("cases", kNone,
                 "Names of the cases to run, which may end in * (default: all); the case that a "
                 "variant is based on is run with it"),
      Key::tables("variant", "Variants of cases, with some keys changed", variant_keys(),
                  UsedBy::named_experiments),
      Key::table("dummy", "Dummy whose head and neck are modelled", dummy_keys(),
                 UsedBy::named_experiments),
      Key::tables("test",
                  "Tests that cases are evaluated by: limits of a regulation, or measured data",
                  test_keys(), UsedBy::named_experiments),
      Key::table("solver", "Time integration of the experiments", kSolverKeys,
                 UsedBy::all_experiments),
      Key::table("output", "Output of results", kOutputKeys, UsedBy::all_experiments),
      Key::table("sweep", "Parameter sweep, for 'flexneck sweep'", sweep_keys(),
                 UsedBy::named_experiments),
      Key::table("fit", "Fit of parameters to targets, for 'flexneck fit'", fit_keys(),
                 UsedBy::named_experiments),
  };
  keys.insert(keys.end(), experiments.begin(), experiments.end());
  return keys;
}

}  // namespace

std::span<const Key> study_keys() {
  static const std::vector<Key> kKeys = all_study_keys();
  return kKeys;
}

}  // namespace flexneck::pipeline
