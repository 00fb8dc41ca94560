// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/uniqueness.h"

#include <algorithm>

#include <fmt/core.h>

namespace flexneck::pipeline {

using Eigen::Index;

namespace {

const std::string& name_of(const FitObjective& objective, Index parameter) {
  return objective.ranges()[static_cast<std::size_t>(parameter)].name;
}

void add_families(const FitResult& result, std::vector<std::string>& clauses) {
  const auto good = std::count_if(result.families.begin(), result.families.end(),
                                  [](const Family& each) { return each.is_as_good; });
  if (good > 1)
    clauses.push_back(fmt::format("{} families of parameters meet the targets equally well", good));
}

void add_open_directions(const FitObjective& objective, const FitResult& result,
                         std::vector<std::string>& clauses) {
  const Identifiability& known = result.known;
  for (Index k = 0; k < known.singular_values.size(); ++k) {
    if (known.singular_values[k] >= kLeastSingularValue) continue;
    const std::vector<Index> along = parameters_along(known.directions.col(k));
    std::string names;
    for (const Index each : along)
      names += (names.empty() ? "'" : ", '") + name_of(objective, each) + "'";
    clauses.push_back(
        fmt::format("no target determines {} (singular value {:.2g}, needed is at least {:.3g})",
                    along.size() > 1 ? "the combination of " + names : names,
                    known.singular_values[k], kLeastSingularValue));
  }
}

void add_profiles(const FitObjective& objective, const FitResult& result,
                  std::vector<std::string>& clauses) {
  std::string open;
  bool is_settled = true;
  for (std::size_t k = 0; k < result.profiles.size(); ++k) {
    const Profile& profile = result.profiles[k];
    if (!profile.low || !profile.high)
      open += (open.empty() ? "'" : ", '") + name_of(objective, static_cast<Index>(k)) + "'";
    is_settled = is_settled && !profile.better;
  }
  if (!open.empty())
    clauses.push_back("the bounds do not contain the confidence interval of " + open);
  if (!is_settled) clauses.emplace_back("the profiles found a better fit; use more starts");
}

void add_bounds(const FitObjective& objective, const FitResult& result,
                std::vector<std::string>& clauses) {
  std::string names;
  for (Index k = 0; k < objective.parameter_count(); ++k)
    if (is_at_bound(result.best().place[k]))
      names += (names.empty() ? "'" : ", '") + name_of(objective, k) + "'";
  if (!names.empty()) clauses.push_back("at a bound: " + names);
}

std::string met_text(const FitObjective& objective, const FitResult& result) {
  return fmt::format(
      "The best {} the targets: chi-squared {:.3g}, at most {:.3g} of {} targets "
      "and priors and {} parameters.",
      result.families.front().meets_targets ? "meets" : "does not meet", result.best().chi_squared,
      largest_good_chi_squared(objective), objective.told_count(), objective.parameter_count());
}

}  // namespace

std::vector<std::string> against_uniqueness(const FitObjective& objective,
                                            const FitResult& result) {
  std::vector<std::string> clauses;
  add_families(result, clauses);
  add_open_directions(objective, result, clauses);
  add_profiles(objective, result, clauses);
  add_bounds(objective, result, clauses);
  return clauses;
}

std::string verdict_of_fit(const FitObjective& objective, const FitResult& result) {
  const std::vector<std::string> clauses = against_uniqueness(objective, result);
  std::string text;
  if (clauses.empty()) {
    text = fmt::format(
        "Unique within the bounds, as far as {} {} show{}",
        result.minima.size() == 1 ? "a single" : std::to_string(result.minima.size()),
        result.minima.size() == 1 ? "start" : "starts", result.minima.size() == 1 ? "s" : "");
  } else {
    text = "Not unique: ";
    for (std::size_t k = 0; k < clauses.size(); ++k) text += (k > 0 ? "; " : "") + clauses[k];
  }
  return text + ". " + met_text(objective, result);
}

}  // namespace flexneck::pipeline
