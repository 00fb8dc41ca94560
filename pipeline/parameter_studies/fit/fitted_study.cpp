// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/fitted_study.h"

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "geometry/foundation/output_file.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/language/document/toml_source.h"
#include "pipeline/parameter_studies/evaluation/figures.h"
#include "pipeline/parameter_studies/fit/fit_tables.h"
#include "pipeline/parameter_studies/fit/uniqueness.h"
#include "pipeline/process/wrapped_text.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> parts_of(const std::string& dotted) {
  std::vector<std::string> parts;
  std::istringstream stream(dotted);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

/// The element with this name, created if there is none.
toml::table& element_named(toml::array& array, const std::string& name) {
  for (toml::node& node : array)
    if ((*node.as_table())["name"].value_or(std::string()) == name) return *node.as_table();
  array.push_back(toml::table{{"name", name}});
  return *array.back().as_table();
}

/// Creates the tables that contain a dotted key; an element of a list of tables is found by its
/// name.
/// @return the innermost table, which has the last part of the key
toml::table& table_for(toml::table& root, const std::vector<std::string>& parts) {
  toml::table* table = &root;
  std::span<const Key> keys = study_keys();
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    const Key* const row = find_key(keys, parts[k]);
    keys = row == nullptr ? std::span<const Key>() : row->keys;
    if (row != nullptr && row->type == KeyType::tables) {
      if (!table->contains(parts[k])) table->insert(parts[k], toml::array());
      table = &element_named(*(*table)[parts[k]].as_array(), parts[k + 1]);
      ++k;
      continue;
    }
    if (!table->contains(parts[k])) table->insert(parts[k], toml::table());
    table = (*table)[parts[k]].as_table();
  }
  return *table;
}

/// Applies a setting as --set does.
void put_setting(toml::table& root, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::vector<std::string> parts = parts_of(setting.substr(0, equals));
  toml::table& table = table_for(root, parts);
  const std::string text = setting.substr(equals + 1);
  try {
    toml::table parsed = toml::parse("value = " + text);
    parsed.get("value")->visit(
        [&](auto& value) { table.insert_or_assign(parts.back(), std::move(value)); });
  } catch (const toml::parse_error&) {
    table.insert_or_assign(parts.back(), text);
  }
}

void put_fitted(toml::table& root, const FitParameter& parameter, const FittedParameter& fitted) {
  toml::table labelled;
  if (parameter.unit.empty()) {
    labelled.insert("value", fitted.value);
  } else {
    labelled.insert("value", exact_text(fitted.value) + " " + parameter.unit);
  }
  labelled.insert("origin", "calibrated");
  const auto end = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", value) : std::string("open");
  };
  labelled.insert("note", "flexneck fit: 95 % confidence from " + end(fitted.low) + " to " +
                              end(fitted.high) +
                              (fitted.is_by_profile ? ", profile likelihood" : ""));
  labelled.is_inline(true);
  const std::vector<std::string> parts = parts_of(parameter.key);
  table_for(root, parts).insert_or_assign(parts.back(), std::move(labelled));
}

/// Name of a target's figure in the verification; empty if it has none.
std::string verified_name(const StudyFit& fit, const FitTarget& target) {
  if (target.output.empty()) return {};
  const OutputName output = output_name(target.output, fit.evaluator().base());
  if (output.figure == kSystemFrequency) return kSystemFrequencyRow;
  if (output.of != OutputName::Of::modes) return {};
  if (output.figure == kMass) return kWeightRow;
  // The name of a mode, such as "bending 1".
  return output.figure.substr(output.figure.find('.') + 1);
}

/// States the figures that the neck is fitted to, if the fit has changed the neck; the former
/// statement no longer holds then.
void put_fitted_to(toml::table& root, const StudyFit& fit, const Study& fitted) {
  const Study& base = fit.evaluator().base();
  if (fitted.neck() == nullptr ||
      neck_values_hash(fitted.parameters) == neck_values_hash(base.parameters))
    return;
  toml::array names;
  for (const FitTarget& each : fit.section().targets) {
    const std::string name = each.is_held_out ? "" : verified_name(fit, each);
    if (!name.empty()) names.push_back(name);
  }
  toml::table& geometry = table_for(root, {"geometry", "fitted_to"});
  geometry.insert_or_assign("fitted_to", std::move(names));
  geometry.insert_or_assign("fitted_values", neck_values_hash(fitted.parameters));
}

std::string comments(const StudyFit& fit, const FitResult& result) {
  const Study& study = fit.evaluator().base();
  std::string text = wrapped(verdict_of_fit(fit.objective(), result), "# ");
  text += wrapped(
      "The values are fitted, not measured; the tables in fit.json show what they are based on.",
      "# ");
  const Provenance made = provenance_of(study);
  std::string inputs;
  for (const InputFile& each : made.inputs)
    inputs += (inputs.empty() ? "" : ", ") + each.name + " " + each.hash;
  text +=
      wrapped("Made by " + made.program + " (" + made.git_hash + ") from " + inputs + ".", "# ");
  for (const std::string& each : fit.section().choices)
    text += wrapped("Chosen with knowledge of the targets: " + each, "# ");
  return text;
}

}  // namespace

std::string fitted_study(StudyFit& fit, const FitResult& result, const fs::path& folder) {
  const Study& study = fit.evaluator().base();
  toml::table root;
  const fs::path base = fs::absolute(study.file).lexically_normal();
  const fs::path from = fs::absolute(folder).lexically_normal();
  root.insert("include", toml::array{base.lexically_proximate(from).string()});
  for (const std::string& setting : study.settings) put_setting(root, setting);
  const std::vector<FittedParameter> fitted = fitted_parameters(fit.objective(), result);
  for (std::size_t k = 0; k < fitted.size(); ++k)
    put_fitted(root, fit.section().parameters[k], fitted[k]);
  const Eigen::VectorXd best = fit.objective().parameters(result.best().place);
  put_fitted_to(root, fit, fit.study(best));
  return comments(fit, result) + toml_text(root) + "\n";
}

}  // namespace flexneck::pipeline
