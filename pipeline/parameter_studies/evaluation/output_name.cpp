// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/output_name.h"

#include <algorithm>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/parameter_studies/evaluation/figures.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace {

using Of = OutputName::Of;

std::vector<std::string> cases_of(const Study& study, CaseSection::Kind kind) {
  std::vector<std::string> names;
  for (const CaseSection& each : study.cases)
    if (each.kind == kind) names.push_back(each.name);
  return names;
}

std::vector<std::string> owners_of(Of of, const Study& study) {
  switch (of) {
    case Of::pendulum:
      return cases_of(study, CaseSection::Kind::pendulum);
    case Of::static_test:
      return cases_of(study, CaseSection::Kind::static_test);
    case Of::verdict:
      return names_of(study.tests);
    case Of::modes:
      break;
  }
  return {};
}

/// Splits off the name of the case or test. Names of cases and of modes may contain dots.
void split_owner(const std::string& rest, const Study& study, OutputName& output) {
  const std::vector<std::string> owners = owners_of(output.of, study);
  for (const std::string& owner : owners) {
    if (!rest.starts_with(owner + ".") || owner.size() <= output.owner.size()) continue;
    output.owner = owner;
    output.figure = rest.substr(owner.size() + 1);
  }
  if (!output.owner.empty()) return;
  const std::string name = rest.substr(0, rest.rfind('.'));
  const bool is_verdict = output.of == Of::verdict;
  if (owners.empty())
    throw InputError("the study has no " + std::string(is_verdict ? "[[test]]" : "case") +
                     " of that kind");
  find_name(owners, name, is_verdict ? "test" : "case");
  throw InputError("expected a figure after the name of the case");
}

/// Text of the parameters that change results, with an empty line at the end of each stage.
std::string text_of(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& each : parameters) {
    const Key* const key = find_dotted_key(study_keys(), each.key).key;
    if (key != nullptr && key->details.changes_results) text += each.key + '\n' + each.value + '\n';
  }
  return text + '\n';
}

}  // namespace

OutputName output_name(const std::string& text, const Study& study) {
  const std::vector<std::string> kinds = {"modes", "pendulum", "static", "verdict"};
  OutputName output;
  output.text = text;
  try {
    const std::size_t dot = text.find('.');
    if (dot == std::string::npos) throw InputError("expected a name such as modes.mass");
    output.of = static_cast<Of>(find_name(kinds, text.substr(0, dot), "kind of output"));
    if (output.of == Of::modes) {
      output.figure = text.substr(dot + 1);
    } else {
      split_owner(text.substr(dot + 1), study, output);
    }
  } catch (const InputError& error) {
    throw InputError("output '" + text + "': " + error.what());
  }
  return output;
}

const TestSection& test_of(const OutputName& output, const Study& study) {
  return study.tests[find_name(names_of(study.tests), output.owner, "test")];
}

const CaseSection& case_of(const OutputName& output, const Study& study) {
  const std::string& name =
      output.of == Of::verdict ? test_of(output, study).experiment : output.owner;
  return study.cases[find_name(names_of(study.cases), name, "case")];
}

bool is_of_attached(const OutputName& output) {
  return output.of == Of::modes && output.figure == kSystemFrequency;
}

std::string values_behind(const OutputName& output, const Study& study) {
  std::string text = text_of(modes_values(study, is_of_attached(output)));
  if (output.of == Of::modes) return text;
  text += text_of(case_provenance(study, case_of(output, study)).parameters);
  if (output.of != Of::verdict) return text;
  std::vector<Parameter> of_test = study.parameters;
  std::erase_if(of_test, [&](const Parameter& each) {
    return !each.key.starts_with("test." + output.owner + ".");
  });
  return text + text_of(of_test);
}

}  // namespace flexneck::pipeline
