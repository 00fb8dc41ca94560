// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/families.h"

#include <algorithm>
#include <numeric>

#include "pipeline/parameter_studies/fit/identifiability.h"

namespace flexneck::pipeline {

namespace {
constexpr double kConfidence = 0.95;
}

double largest_good_chi_squared(const FitObjective& objective) {
  const double more = static_cast<double>(objective.told_count() - objective.parameter_count());
  return chi_squared_quantile(kConfidence, std::max(1.0, more));
}

std::vector<Family> families_of(const FitObjective& objective, const std::vector<Minimum>& minima) {
  std::vector<std::size_t> order(minima.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return minima[a].chi_squared < minima[b].chi_squared;
  });
  std::vector<Family> families;
  for (const std::size_t start : order) {
    const Minimum& minimum = minima[start];
    if (minimum.has_failed()) continue;
    const auto same = std::find_if(families.begin(), families.end(), [&](const Family& each) {
      return (each.best.place - minimum.place).cwiseAbs().maxCoeff() < kSamePlace;
    });
    if (same != families.end()) {
      same->starts.push_back(start);
    } else {
      families.push_back({minimum, {start}, false, false});
    }
  }
  if (families.empty()) return families;
  const double least = families.front().best.chi_squared;
  const double more =
      chi_squared_quantile(kConfidence, static_cast<double>(objective.parameter_count()));
  const double good = largest_good_chi_squared(objective);
  for (Family& each : families) {
    each.is_as_good = each.best.chi_squared - least <= more;
    each.meets_targets = each.best.chi_squared <= good;
  }
  return families;
}

}  // namespace flexneck::pipeline
