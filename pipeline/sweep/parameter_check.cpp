// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/sweep/parameter_check.h"

#include <algorithm>
#include <memory>
#include <set>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

namespace {

/// The study with one setting. @param problem  why it is refused, if it is
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

void check_keys(const SweepRows& sweep, const std::string& file) {
  std::set<std::string> keys;
  for (const SweepParameter& each : sweep.section().parameters) {
    if (each.key.starts_with("sweep."))
      throw InputError(file + ": sweep.parameter '" + each.name +
                       "': expected a key of the study, found one of the sweep itself");
    if (!keys.insert(each.key).second)
      throw InputError(file + ": sweep.parameter '" + each.name +
                       "': expected each key once, found '" + each.key + "' again");
  }
}

}  // namespace

void check_parameters(Evaluator& evaluator, const SweepRows& sweep, const WantedOutputs& wanted) {
  const std::string file = evaluator.base().file.string();
  check_keys(sweep, file);
  const std::vector<SweepParameter>& parameters = sweep.section().parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto refuse = [&](const std::string& why) {
      throw InputError(file + ": sweep.parameter '" + parameters[k].name + "': " + why);
    };
    const auto [first, second] = sweep.two_settings(k);
    std::string problem;
    const auto a = study_with(evaluator, first, problem);
    const auto b = study_with(evaluator, second, problem);
    if (!a && !b) refuse(problem);
    if (a && b && first != second && !is_any_different(*a, *b, wanted))
      refuse("expected a key that an output depends on, found '" + parameters[k].key +
             "', which none of sweep.outputs and sweep.curves does; leave it out");
  }
}

std::string definition_of(const Study& study) {
  // A line break ends each field: keys, values and names have none.
  std::string text = hash_of_file("/proc/self/exe") + '\n';
  for (const std::vector<Parameter>* const list : {&study.parameters, &study.defaults})
    for (const Parameter& each : *list) text += each.key + '\n' + each.value + '\n';
  for (const InputFile& each : study.tables) text += each.name + '\n' + each.hash + '\n';
  std::set<std::filesystem::path> files;
  if (study.structure) files.insert(study.structure->file());
  if (study.matrices)
    files.insert({study.matrices->stiffness, study.matrices->mass, study.matrices->nodes});
  for (const TestSection& each : study.tests) files.insert(each.file);
  for (const std::filesystem::path& each : files)
    text += each.filename().string() + '\n' + hash_of_file(each.string()) + '\n';
  return hash_of_text(text);
}

}  // namespace flexneck::pipeline
