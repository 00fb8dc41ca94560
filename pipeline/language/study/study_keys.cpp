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

}  // namespace flexneck::pipeline
