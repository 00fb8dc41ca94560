// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/origins.h"

#include <algorithm>
#include <array>

namespace flexneck::pipeline {

namespace {

/// False for texts such as names, whose origin is not reported.
bool is_figure(const std::string& key) {
  const Key* const row = find_dotted_key(study_keys(), key).key;
  return row == nullptr || (row->type != KeyType::text && row->type != KeyType::texts);
}

}  // namespace

std::string origins_of(const std::vector<Parameter>& parameters, const std::string& table,
                       const std::vector<std::string>& keys) {
  const std::string prefix = table.empty() ? "" : table + ".";
  std::array<bool, kOriginNames.size()> found{};
  for (const Parameter& parameter : parameters) {
    if (!parameter.key.starts_with(prefix)) continue;
    const std::string key = parameter.key.substr(prefix.size());
    if (keys.empty() ? is_figure(parameter.key)
                     : std::find(keys.begin(), keys.end(), key) != keys.end())
      found.at(static_cast<std::size_t>(parameter.origin)) = true;
  }
  std::string text;
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found.at(k)) text += (text.empty() ? "" : " and ") + std::string(kOriginNames[k]);
  return text;
}

std::vector<const PulseSection*> pulses_in_use(const Study& study) {
  std::vector<const PulseSection*> pulses;
  for (const PulseSection& pulse : study.pulses)
    if (std::any_of(study.cases.begin(), study.cases.end(),
                    [&](const CaseSection& each) { return each.pulse == pulse.name; }))
      pulses.push_back(&pulse);
  return pulses;
}

std::string pulse_origins(const Study& study) {
  std::string text;
  for (const PulseSection* const pulse : pulses_in_use(study))
    text += (text.empty() ? "'" : ", '") + pulse->name + "' " +
            origins_of(study.parameters, "pulse." + pulse->name);
  return text;
}

}  // namespace flexneck::pipeline
