// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/varied_key.h"

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string_view>

#include "geometry/foundation/build_id.h"
#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

namespace {

/// Adds the units in a text such as "m | kg".
void add_units(std::string_view units, std::set<std::string>& found) {
  while (!units.empty()) {
    const std::size_t bar = units.find(" | ");
    found.emplace(units.substr(0, bar));
    units = bar == std::string_view::npos ? "" : units.substr(bar + 3);
  }
}

void add_all_units(std::span<const Key> keys, std::set<std::string>& found) {
  for (const Key& key : keys) {
    add_units(key.unit, found);
    add_all_units(key.keys, found);
  }
}

/// SI units that a key may have; for a variable, which is substituted for other values, any.
std::set<std::string> si_units_of(const std::string& key) {
  std::set<std::string> units;
  const Key* const row = find_dotted_key(study_keys(), key).key;
  if (row == nullptr || key.starts_with("variables.")) {
    add_all_units(study_keys(), units);
  } else {
    add_units(row->unit, units);
  }
  return units;
}

/// Reads the study with one setting. @param problem  reason of a refusal
std::unique_ptr<const Study> study_with(Evaluator& evaluator, const std::string& setting,
                                        std::string& problem) {
  try {
    return std::make_unique<const Study>(evaluator.study({setting}));
  } catch (const InputError& error) {
    problem = "with " + setting + ": " + error.what();
    return nullptr;
  }
}

bool is_any_different(const Study& a, const Study& b, const WantedOutputs& wanted) {
  const auto differs = [&](const OutputName& each) {
    return values_behind(each, a) != values_behind(each, b);
  };
  return std::any_of(wanted.figures.begin(), wanted.figures.end(), differs) ||
         std::any_of(wanted.curves.begin(), wanted.curves.end(), differs);
}

}  // namespace

SiUnit si_unit_of(const VariedKey& varied) {
  if (varied.unit.empty()) return {"1", 1};
  const std::set<std::string> units = si_units_of(varied.key);
  std::string names;
  for (const std::string& unit : units) {
    try {
      return {unit, 1 / factor_from_si(unit, varied.unit)};
    } catch (const InputError&) {
      names += (names.empty() ? "" : ", ") + unit;
    }
  }
  throw InputError(varied.who + ": " +
                   (units.empty()
                        ? "expected no unit: '" + varied.key + "' is a pure number"
                        : "expected a unit such as " + names + ", found '" + varied.unit + "'"));
}

std::string setting_of(const VariedKey& varied, double value) {
  if (varied.unit.empty()) return varied.key + "=" + exact_text(value);
  return varied.key + "=\"" + exact_text(value) + " " + varied.unit + "\"";
}

void check_varied(Evaluator& evaluator, const std::vector<TwoSettings>& all,
                  const WantedOutputs& wanted, const std::string& own_table,
                  const std::string& outputs) {
  const std::string file = evaluator.base().file.string();
  std::set<std::string> keys;
  for (const TwoSettings& each : all) {
    const std::string who = file + ": " + each.varied.who + ": ";
    if (each.varied.key.starts_with(own_table + "."))
      throw InputError(who + "expected a key of the study, found one of the " + own_table +
                       " itself");
    if (!keys.insert(each.varied.key).second)
      throw InputError(who + "expected each key once, found '" + each.varied.key + "' again");
  }
  for (const TwoSettings& each : all) {
    const std::string who = file + ": " + each.varied.who + ": ";
    std::string problem;
    const auto a = study_with(evaluator, each.first, problem);
    const auto b = study_with(evaluator, each.second, problem);
    if (!a && !b) throw InputError(who + problem);
    if (a && b && each.first != each.second && !is_any_different(*a, *b, wanted))
      throw InputError(who + "expected a key that an output depends on, found '" + each.varied.key +
                       "', on which none of " + outputs + " depends; remove it");
  }
}

std::string definition_of(const Study& study) {
  // A line break ends each field: keys, values and names contain none.
  std::string text = build_id() + '\n';
  for (const std::vector<Parameter>* const list : {&study.parameters, &study.defaults})
    for (const Parameter& each : *list) text += each.key + '\n' + each.value + '\n';
  return hash_of_text(text);
}

}  // namespace flexneck::pipeline
