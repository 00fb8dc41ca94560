// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/relaxation.h"

#include <cmath>
#include <numeric>
#include <string>

#include <fmt/core.h>

#include "geometry/foundation/output_file.h"

namespace flexneck::pipeline {

double Relaxation::sum_of_shares() const {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

void Relaxation::apply(const multibody::Section::Stiffness& relaxing,
                       multibody::Section& section) const {
  if (times_s.empty()) return;
  section.stiffness -= relaxing;
  for (std::size_t k = 0; k < times_s.size(); ++k)
    section.branches.push_back({shares[k] / sum_of_shares() * relaxing, times_s[k]});
}

namespace {

/// Factor on the relaxation times at the reference temperature.
double shift_factor(const StudyTable& shift) {
  const double temperature_K = shift.quantity("temperature");
  const double low_K = shift.quantity("from");
  const double high_K = shift.quantity("to");
  if (!(low_K <= temperature_K && temperature_K <= high_K))
    shift.refuse("temperature", "expected a temperature within the range of the shift, " +
                                    rounded_text(low_K) + " K to " + rounded_text(high_K) +
                                    " K, found " + rounded_text(temperature_K) + " K");
  const double above_K = temperature_K - shift.quantity("reference");
  const double c2_K = shift.quantity("c2");
  if (!(c2_K + above_K > 0))
    shift.refuse(
        "c2", "expected more than the difference of the reference temperature and the temperature");
  const double factor = std::pow(10.0, -shift.number("c1") * above_K / (c2_K + above_K));
  shift.finish();
  return factor;
}

/// Branches given by their times and shares.
Relaxation given_branches(const StudyTable& table) {
  Relaxation relaxation;
  if (table.has("relaxation_times"))
    relaxation.times_s = table.quantities("relaxation_times", 0, "s");
  if (table.has("relaxation_shares")) relaxation.shares = table.numbers("relaxation_shares");
  if (relaxation.shares.size() != relaxation.times_s.size())
    table.refuse("relaxation_shares", "expected one share per relaxation time, " +
                                          std::to_string(relaxation.times_s.size()) + ", found " +
                                          std::to_string(relaxation.shares.size()));
  for (const double share : relaxation.shares)
    if (!(share > 0)) table.refuse("relaxation_shares", "expected positive shares");
  if (relaxation.sum_of_shares() > 1 + 1e-12)
    table.refuse("relaxation_shares", "expected shares whose sum is at most 1");
  return relaxation;
}

Relaxation fitted_branches(const StudyTable& table) {
  table.refuse_given({"relaxation_times", "relaxation_shares"},
                     "has no effect beside relaxation_law, to which the branches are fitted");
  return read_relaxation_law(table.table("relaxation_law"));
}

std::pair<double, double> read_band(const StudyTable& table) {
  const std::vector<double> band_Hz = table.quantities("relaxation_band");
  if (!(0 <= band_Hz[0] && band_Hz[0] < band_Hz[1]))
    table.refuse("relaxation_band", "expected the lower frequency first");
  return {band_Hz[0], band_Hz[1]};
}

}  // namespace

Relaxation read_relaxation(const StudyTable& table) {
  Relaxation relaxation =
      table.has("relaxation_law") ? fitted_branches(table) : given_branches(table);
  if (relaxation.times_s.empty()) {
    table.refuse_given({"shift", "relaxation_band"},
                       "has no effect without relaxation_times or relaxation_law");
    return relaxation;
  }
  if (table.has("relaxation_band")) relaxation.band_Hz = read_band(table);
  if (!table.has("shift")) return relaxation;
  const double factor = shift_factor(table.table("shift"));
  for (double& time_s : relaxation.times_s) time_s *= factor;
  if (!relaxation.fit.empty())
    relaxation.fit +=
        fmt::format(", at the reference temperature; times shifted by {:.3g}", factor);
  return relaxation;
}

}  // namespace flexneck::pipeline
