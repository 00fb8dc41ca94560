// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/fit_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "pipeline/parameter_studies/fit/uniqueness.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::string number(double value, int digits = 5) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return "open";
  return fmt::format("{:.{}g}", value, digits);
}

std::string unit_text(const std::string& unit) { return unit.empty() ? "1" : unit; }

std::vector<ResultTable::Column> named(const std::vector<FitParameter>& parameters,
                                       std::vector<ResultTable::Column> columns) {
  for (const FitParameter& each : parameters) columns.push_back({each.name, each.unit});
  return columns;
}

ResultTable parameter_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit parameters";
  table.title = "Fitted parameters, with 95 % confidence";
  table.columns = {{"parameter", ""}, {"unit", ""},   {"value", ""},  {"from", ""},
                   {"to", ""},        {"by", ""},     {"bounds", ""}, {"start", ""},
                   {"deviation", ""}, {"remark", ""}, {"key", ""}};
  const FitObjective& objective = fit.objective();
  const std::vector<FittedParameter> fitted = fitted_parameters(objective, result);
  const VectorXd start = objective.parameters(fit.start());
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const FitParameter& of = fit.section().parameters[k];
    const auto place = static_cast<Index>(k);
    table.rows.push_back({of.name, unit_text(of.unit), number(fitted[k].value, 6),
                          number(fitted[k].low), number(fitted[k].high),
                          fitted[k].is_by_profile ? "profile" : "linear theory",
                          fmt::format("{:g} to {:g}", of.from, of.to), number(start[place]),
                          number(fitted[k].deviation, 3),
                          is_at_bound(result.best().place[place]) ? "at its bound" : "", of.key});
  }
  table.notes = {verdict_of_fit(objective, result)};
  if (fit.section().choices.empty()) table.notes.push_back(choices_text(fit.section()));
  return table;
}

std::string error_text(double value, double wanted) {
  return wanted == 0 ? "-" : fmt::format("{:+.3f}", 100 * (value / wanted - 1));
}

/// Row of a target; all points of a curve share one row.
std::vector<std::string> target_row(const ShownTarget& shown, const FitObjective& objective,
                                    const VectorXd& values, std::size_t first, std::size_t count) {
  const FitTerm& term = objective.terms()[first];
  double squares = 0;
  bool are_inside = true;
  for (std::size_t k = first; k < first + count; ++k) {
    squares += std::pow(objective.terms()[k].residual(values[static_cast<Index>(k)]), 2);
    are_inside = are_inside && objective.terms()[k].is_met(values[static_cast<Index>(k)], 0);
  }
  const double value = values[static_cast<Index>(first)];
  const bool is_one = count == 1;
  const double residual =
      is_one ? term.residual(value) : std::sqrt(squares / static_cast<double>(count));
  return {shown.name,
          shown.wanted,
          is_one ? number(value * shown.factor) : fmt::format("{} points", count),
          unit_text(shown.unit),
          is_one && !term.window ? error_text(value, term.value) : "-",
          number(residual, 3),
          term.window ? (are_inside ? "inside" : "OUTSIDE") : "",
          term.is_held_out ? "held out"
          : term.must_hold ? "must hold"
                           : "fitted",
          std::string(name_of(shown.origin)),
          shown.output};
}

ResultTable target_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit targets";
  table.title = "Targets and values of the best fit";
  table.columns = {{"target", ""},     {"wanted", ""}, {"fit", ""}, {"unit", ""},   {"error", "%"},
                   {"deviations", ""}, {"window", ""}, {"use", ""}, {"origin", ""}, {"output", ""}};
  const std::vector<FitTerm>& terms = fit.objective().terms();
  std::size_t first = 0;
  for (const ShownTarget& shown : fit.targets()) {
    std::size_t end = first;
    while (end < terms.size() && terms[end].target == shown.name) ++end;
    table.rows.push_back(
        target_row(shown, fit.objective(), result.best().values, first, end - first));
    first = end;
  }
  table.notes = {
      "Deviations: distance in standard deviations; for a curve their root mean square, for a "
      "window the distance from its nearer edge in units of its smoothing."};
  return table;
}

ResultTable family_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit families";
  table.title = "Minima found by the fits, the best first";
  table.columns = named(fit.section().parameters,
                        {{"family", ""}, {"chi-squared", ""}, {"starts", ""}, {"verdict", ""}});
  for (std::size_t k = 0; k < result.families.size(); ++k) {
    const Family& family = result.families[k];
    std::vector<std::string> row = {std::to_string(k + 1), number(family.best.chi_squared, 4),
                                    std::to_string(family.starts.size()),
                                    family.meets_targets ? "meets the targets"
                                    : family.is_as_good  ? "as good as the best"
                                                         : "worse"};
    if (!family.best.has_converged) row.back() += ", not converged";
    const VectorXd at = fit.objective().parameters(family.best.place);
    for (Index i = 0; i < at.size(); ++i)
      row.push_back(number(at[i]) + (is_at_bound(family.best.place[i]) ? " (bound)" : ""));
    table.rows.push_back(std::move(row));
  }
  const auto failed = std::count_if(result.minima.begin(), result.minima.end(),
                                    [](const Minimum& each) { return each.has_failed(); });
  table.notes = {
      fmt::format("{} starts that the study accepts, {} of which failed. Minima that differ by at "
                  "most {:g} of the width of the bounds form one family.",
                  result.minima.size(), failed, kSamePlace)};
  return table;
}

ResultTable direction_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit directions";
  table.title = "Directions in parameter space and how well the targets determine them";
  table.columns = named(fit.section().parameters, {{"singular value", ""}, {"fixed", ""}});
  for (ResultTable::Column& column : table.columns) column.unit.clear();
  const Identifiability& known = result.known;
  for (Index k = 0; k < known.singular_values.size(); ++k) {
    std::vector<std::string> row = {
        number(known.singular_values[k], 4),
        known.singular_values[k] < kLeastSingularValue ? "by no target" : "yes"};
    for (const double part : known.directions.col(k)) row.push_back(fmt::format("{:+.3f}", part));
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "Singular values of the Jacobian of the targets, in standard deviations per width of the "
      "bounds. Below 3.46, the standard deviation along the direction exceeds that of a uniform "
      "distribution within the bounds."};
  return table;
}

ResultTable correlation_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit correlations";
  table.title = "Correlations of the fitted parameters";
  table.columns = named(fit.section().parameters, {{"parameter", ""}});
  for (ResultTable::Column& column : table.columns) column.unit.clear();
  for (std::size_t i = 0; i < fit.section().parameters.size(); ++i) {
    table.rows.push_back({fit.section().parameters[i].name});
    for (const double each : result.known.correlations.row(static_cast<Index>(i)))
      table.rows.back().push_back(std::isnan(each) ? "-" : fmt::format("{:+.3f}", each));
  }
  return table;
}

ResultTable contribution_table(const StudyFit& fit, const FitResult& result) {
  ResultTable table;
  table.name = "fit contributions";
  table.title = "Contributions of the targets to the certainty of the parameters";
  table.columns = named(fit.section().parameters, {{"without", ""}});
  for (ResultTable::Column& column : table.columns) column.unit.clear();
  const Identifiability& known = result.known;
  for (std::size_t k = 0; k < known.targets.size(); ++k) {
    table.rows.push_back({known.targets[k]});
    for (const double each : known.widening.row(static_cast<Index>(k)))
      table.rows.back().push_back(std::isinf(each) ? "alone" : fmt::format("{:.3g}", each));
  }
  table.notes = {
      "Factor by which the uncertainty of the parameter would increase without the target; "
      "\"alone\": no other target determines it."};
  return table;
}

ResultTable history_table(const StudyFit& fit, const HistoryMatch& history) {
  ResultTable table;
  table.name = "fit history";
  table.title = "Share of the prior that meets the targets, with 95 % confidence";
  table.columns = {{"target", ""}, {"points", ""}, {"of", ""},
                   {"share", "%"}, {"from", "%"},  {"to", "%"}};
  const auto add = [&](const std::string& name, const Share& share) {
    table.rows.push_back({name, std::to_string(share.count), std::to_string(share.of),
                          number(100 * share.value, 4), number(100 * share.low, 4),
                          number(100 * share.high, 4)});
  };
  const std::vector<std::pair<std::string, bool>> targets = targets_of(fit.objective());
  add("all that are fitted", history.all);
  for (std::size_t k = 0; k < targets.size(); ++k)
    add(targets[k].first + (targets[k].second ? " (held out)" : ""), history.by_target[k]);
  table.notes = {
      fmt::format("Random points of the prior, {} of which failed. A window is met within its "
                  "limits, a corridor within its limits at all points, a value within {:g} "
                  "standard deviations, and a curve if the root mean square of its deviations is "
                  "within as many. Confidence after Clopper and Pearson.",
                  history.failed, fit.section().history_deviations)};
  return table;
}

ResultTable choice_table(const StudyFit& fit) {
  ResultTable table;
  table.name = "fit choices";
  table.title = "Choices made with knowledge of the targets";
  table.columns = {{"choice", ""}};
  for (const std::string& each : fit.section().choices) table.rows.push_back({each});
  return table;
}

ResultTable failure_table(const FitResult& result) {
  ResultTable table;
  table.name = "fit failures";
  table.title = "Starts whose fits failed";
  table.columns = {{"start", ""}, {"why", ""}};
  for (std::size_t k = 0; k < result.minima.size(); ++k)
    if (result.minima[k].has_failed())
      table.rows.push_back({std::to_string(k), result.minima[k].problem});
  return table;
}

}  // namespace

std::vector<FittedParameter> fitted_parameters(const FitObjective& objective,
                                               const FitResult& result) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  constexpr double kTwoSided = 1.959963984540054;  // normal quantile of 0.975
  std::vector<FittedParameter> all;
  const VectorXd at = objective.parameters(result.best().place);
  for (Index k = 0; k < at.size(); ++k) {
    const FitRange& range = objective.ranges()[static_cast<std::size_t>(k)];
    FittedParameter found;
    found.value = at[k];
    found.deviation = result.known.deviation(k) * range.width();
    found.is_by_profile = !result.profiles.empty();
    if (found.is_by_profile) {
      const Profile& profile = result.profiles[static_cast<std::size_t>(k)];
      found.low = profile.low ? range.from + *profile.low * range.width() : -kOpen;
      found.high = profile.high ? range.from + *profile.high * range.width() : kOpen;
    } else {
      found.low = found.value - kTwoSided * found.deviation;
      found.high = found.value + kTwoSided * found.deviation;
      // Beyond the parameter's bounds the interval is open.
      if (found.low < range.from) found.low = -kOpen;
      if (found.high > range.to) found.high = kOpen;
    }
    all.push_back(found);
  }
  return all;
}

std::string choices_text(const FitSection& section) {
  if (section.choices.empty())
    return "The study states no choices that were made with knowledge of the targets "
           "(fit.choices).";
  std::string text = "Chosen with knowledge of the targets:";
  for (std::size_t k = 0; k < section.choices.size(); ++k)
    text += fmt::format(" ({}) {}", k + 1, section.choices[k]);
  return text;
}

std::vector<ResultTable> fit_tables(const StudyFit& fit, const FitResult& result) {
  std::vector<ResultTable> tables = {parameter_table(fit, result)};
  if (!fit.section().choices.empty()) tables.push_back(choice_table(fit));
  tables.push_back(target_table(fit, result));
  tables.push_back(family_table(fit, result));
  tables.push_back(direction_table(fit, result));
  tables.push_back(correlation_table(fit, result));
  tables.push_back(contribution_table(fit, result));
  if (result.history.places.cols() > 0) tables.push_back(history_table(fit, result.history));
  ResultTable failures = failure_table(result);
  if (!failures.rows.empty()) tables.push_back(std::move(failures));
  return tables;
}

}  // namespace flexneck::pipeline
