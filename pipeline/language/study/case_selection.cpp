// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "geometry/foundation/names.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

std::set<std::string> chosen_cases(const StudyTable& root, const std::vector<CaseSection>& cases) {
  std::set<std::string> names;
  if (!root.has("cases")) {
    for (const CaseSection& each : cases) names.insert(each.name);
    return names;
  }
  for (const std::string& pattern : root.texts("cases")) {
    bool found = false;
    for (const CaseSection& experiment : cases) {
      if (!fits(experiment.name, pattern)) continue;
      found = true;
      names.insert(experiment.name);
      if (!experiment.variant_of.empty()) names.insert(experiment.variant_of);
    }
    if (!found)
      root.refuse("cases",
                  "there is no case '" + pattern + "'" + did_you_mean(names_of(cases), pattern));
  }
  return names;
}

bool fits(const std::string& name, const std::string& pattern) {
  if (!pattern.ends_with('*')) return name == pattern;
  return name.starts_with(pattern.substr(0, pattern.size() - 1));
}

void select_cases(const StudyTable& root, Study& study) {
  if (!root.has("cases")) return;
  const std::set<std::string> names = chosen_cases(root, study.cases);
  std::erase_if(study.cases,
                [&](const CaseSection& experiment) { return !names.contains(experiment.name); });
  const auto is_gone = [&](const auto& test) { return !names.contains(test.experiment); };
  std::erase_if(study.tests, is_gone);
  std::erase_if(study.measured, is_gone);
}

}  // namespace flexneck::pipeline
