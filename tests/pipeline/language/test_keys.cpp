// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of keys, compared with the shipped files and with the structures that are read.
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <toml++/toml.h>

#include "geometry/foundation/temporary_folder.h"
#include "geometry/foundation/units.h"
#include "pipeline/experiments/verification/reference.h"
#include "pipeline/language/document/key_reference.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/language/study/regulation.h"
#include "pipeline/language/study/study.h"
#include "pipeline/results/report/paper_context.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = FLEXNECK_SOURCE_DIR;

std::span<const Key> keys_of(const fs::path& file) {
  const std::string folder = file.parent_path().filename();
  if (folder == "models") return model_keys();
  if (folder == "regulations") return regulation_keys();
  if (folder != "verification") return study_keys();
  return file.stem() == "hybrid3" ? reference_keys() : context_keys();
}

/// Counts the known keys of a table; unknown keys fail the test.
int count_known(const toml::table& table, std::span<const Key> keys, const std::string& path) {
  int known = 0;
  for (const auto& [name, node] : table) {
    const std::string key(name.str());
    if (path.empty() && key == "include") continue;
    INFO(path + "." + key);
    const Key* const row = find_key(keys, key);
    REQUIRE(row != nullptr);
    if (row->type == KeyType::table) {
      REQUIRE(node.is_table());
      known += count_known(*node.as_table(), row->keys, path + "." + key);
    } else if (row->type == KeyType::tables) {
      REQUIRE(node.is_array_of_tables());
      for (const toml::node& each : *node.as_array())
        known += count_known(*each.as_table(), row->keys, path + "." + key);
    } else {
      ++known;
    }
  }
  return known;
}

/// Calls visit(path, key) for all rows.
template <class Visit>
void visit_all(std::span<const Key> keys, const std::string& path, const Visit& visit) {
  for (const Key& key : keys) {
    const std::string name = path + std::string(key.name);
    visit(name, key);
    visit_all(key.keys, name + ".", visit);
  }
}

template <class Visit>
void visit_formats(const Visit& visit) {
  visit_all(study_keys(), "study ", visit);
  visit_all(model_keys(), "model ", visit);
  visit_all(reference_keys(), "reference ", visit);
  visit_all(context_keys(), "context ", visit);
  visit_all(regulation_keys(), "regulation ", visit);
}

}  // namespace

TEST_CASE("every key of every shipped file stands in a table of keys") {
  int files = 0;
  int keys = 0;
  for (const char* const folder : {"geometry", "pipeline"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".toml") continue;
      INFO(entry.path().string());
      keys += count_known(toml::parse_file(entry.path().string()), keys_of(entry.path()), "");
      ++files;
    }
  }
  CHECK(files >= 20);
  CHECK(keys >= 500);
}

TEST_CASE("rows of the tables of keys are sound: units, fallbacks, choices, sentences") {
  int rows = 0;
  visit_formats([&](const std::string& path, const Key& key) {
    INFO(path);
    ++rows;
    CHECK_FALSE(key.what.empty());
    CHECK_FALSE(key.what.ends_with('.'));
    const bool is_table = key.type == KeyType::table || key.type == KeyType::tables;
    CHECK(is_table == !key.keys.empty());
    CHECK((is_table || key.keys.data() == nullptr));
    for (std::string_view rest = key.unit; !rest.empty();) {
      const std::size_t bar = rest.find(" | ");
      CHECK_NOTHROW(parse_quantity("1 " + std::string(rest.substr(0, bar)), rest.substr(0, bar)));
      rest = bar == std::string_view::npos ? "" : rest.substr(bar + 3);
    }
    const bool has_fallback = key.fallback != kRequired && key.fallback != kNone;
    if (key.details.choices != nullptr && has_fallback) {
      const std::vector<std::string> choices = key.details.choices();
      CHECK(std::count(choices.begin(), choices.end(), key.fallback) == 1);
    }
    const bool is_number =
        key.type == KeyType::count || key.type == KeyType::number || key.type == KeyType::quantity;
    if (is_number && has_fallback)
      CHECK(key.details.range.contains(std::stod(std::string(key.fallback))));
  });
  CHECK(rows > 260);
}

TEST_CASE("what a file does not say is what the structures of the program begin with") {
  const TemporaryFolder folder;
  std::ofstream(folder / "model.toml") << "[solver]\nend_time = \"1 s\"\n"
                                          "[[body]]\nname = \"ground\"\nkind = \"ground\"\n";
  const ModelFile model = read_model_file(folder / "model.toml", {});
  const multibody::SolverOptions options;
  CHECK(model.solver.relative_tolerance == options.relative_tolerance);
  CHECK(model.solver.absolute_tolerance == options.absolute_tolerance);
  CHECK(model.solver.max_step_s == options.max_step_s);
  CHECK(model.solver.min_step_s == options.min_step_s);
  CHECK(model.solver.resolution_s == options.resolution_s);
  CHECK(model.solver.max_steps == options.max_steps);
  CHECK(model.solver.spectral_radius == options.spectral_radius);
  CHECK(model.solver.formulation == options.formulation);
  CHECK(model.solver.integrator == options.integrator);
  CHECK(model.output.interval_s == OutputSection().interval_s);

  std::ofstream(folder / "study.toml") << "";
  const Study study = read_study(folder / "study.toml", {});
  const ModesSection modes;
  CHECK(study.modes.count == modes.count);
  CHECK(study.modes.formulation == modes.formulation);
  CHECK(study.modes.solver == modes.solver);
  CHECK(study.modes.basis == modes.basis);
  CHECK(study.solver.max_step_s == options.max_step_s);
  CHECK(study.output_interval_s == Study().output_interval_s);
}

TEST_CASE("a value counts for the results that its section is used by, whatever names it has") {
  const auto user = [](const char* key) { return find_dotted_key(study_keys(), key).used_by; };
  CHECK(user("geometry.length") == UsedBy::mesh);
  CHECK(user("geometry.materials.rubber.density") == UsedBy::mesh);
  CHECK(user("geometry.materials.rubber.formulation") == UsedBy::modes);
  CHECK(user("geometry.materials.rubber 1.5.static_modulus_ratio") == UsedBy::modes);
  CHECK(user("substructures.piece.disc.parts") == UsedBy::modes);
  CHECK(user("body.head.mass") == UsedBy::all_experiments);
  CHECK(user("case.flexion-5.5.duration") == UsedBy::named_experiments);
  CHECK_FALSE(find_dotted_key(study_keys(), "modes.check").key->details.changes_results);
  CHECK(find_dotted_key(study_keys(), "modes.count").key->details.changes_results);
  CHECK(find_dotted_key(study_keys(), "modes.counts").key == nullptr);
  CHECK(find_dotted_key(study_keys(), "case.flexion.durations").key == nullptr);
}

TEST_CASE("the reference of keys has each with unit, default and meaning in 100 columns") {
  const DottedKey joint = find_dotted_key(model_keys(), "joint");
  REQUIRE(joint.key != nullptr);
  const std::string text = table_text("joint", *joint.key);
  CHECK_THAT(text, Contains("[[joint]] Joints between markers\n"));
  CHECK_THAT(text,
             Contains("  angle (quantity in rad; default 0)\n      Initial angle, any number of "
                      "turns; if not given, from the bodies' positions, -180 to 180 deg\n"));
  CHECK_THAT(text, Contains("  axis (list of 3 numbers)\n"));
  visit_formats([&](const std::string&, const Key& key) {
    std::istringstream lines(key.keys.empty() ? key_text(key)
                                              : table_text("x", key) + tables_text(key.keys));
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
  });
}
