// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/sweep_summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Samples in which every row has the output, a column each.
struct CompleteSamples {
  MatrixXd values;
  std::vector<std::uint64_t> numbers;
};

CompleteSamples complete_samples(const VectorXd& figures, Index rows_per_sample) {
  const Index count = figures.size() / rows_per_sample;
  const auto all = figures.reshaped(rows_per_sample, count);
  CompleteSamples complete;
  for (Index k = 0; k < count; ++k)
    if (!all.col(k).array().isNaN().any())
      complete.numbers.push_back(static_cast<std::uint64_t>(k));
  complete.values.resize(rows_per_sample, static_cast<Index>(complete.numbers.size()));
  for (std::size_t k = 0; k < complete.numbers.size(); ++k)
    complete.values.col(static_cast<Index>(k)) = all.col(static_cast<Index>(complete.numbers[k]));
  return complete;
}

Sensitivity sensitivity_of(const SweepRows& sweep, const VectorXd& figures) {
  constexpr std::size_t kLeast = 2;  // minimum number of samples for a variance
  const SweepSection& section = sweep.section();
  const auto seed = static_cast<std::uint64_t>(section.seed);
  const CompleteSamples complete =
      complete_samples(figures, static_cast<Index>(sweep.rows_per_sample()));
  Sensitivity result;
  result.left_out = sweep.count() / sweep.rows_per_sample() - complete.numbers.size();
  if (complete.numbers.size() < kLeast) return result;
  if (section.plan == SweepPlan::sobol_indices) result.sobol = sobol_indices(complete.values, seed);
  if (section.plan == SweepPlan::shapley)
    result.shapley = shapley_effects(complete.values, complete.numbers, sweep.shapley(), seed);
  return result;
}

std::string text_of(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

std::vector<double> known_values(const VectorXd& figures) {
  std::vector<double> known;
  for (const double figure : figures)
    if (!std::isnan(figure)) known.push_back(figure);
  std::sort(known.begin(), known.end());
  return known;
}

ResultTable percentile_table(const std::vector<OutputColumn>& outputs, const SweepTable& table) {
  ResultTable result;
  result.name = "percentiles";
  result.title = "Outputs over all rows";
  result.columns = {
      {"output", ""}, {"unit", ""},   {"rows", ""}, {"mean", ""}, {"standard deviation", ""},
      {"least", ""},  {"5 %", ""},    {"25 %", ""}, {"50 %", ""}, {"75 %", ""},
      {"95 %", ""},   {"largest", ""}};
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const std::vector<double> known = known_values(table.figures.row(static_cast<Index>(k)));
    std::vector<std::string> row = {outputs[k].name, outputs[k].unit, std::to_string(known.size())};
    if (known.empty()) {
      row.resize(result.columns.size(), "-");
    } else {
      const auto count = static_cast<Index>(known.size());
      const VectorXd sorted = VectorXd::Map(known.data(), count);
      const double mean = sorted.mean();
      const double square = (sorted.array() - mean).square().sum();
      const double deviation =
          count > 1 ? std::sqrt(square / static_cast<double>(count - 1)) : std::nan("");
      row.insert(row.end(), {text_of(mean), text_of(deviation), text_of(sorted[0])});
      for (const double share : kBandShares) row.push_back(text_of(sorted_quantile(sorted, share)));
      row.push_back(text_of(sorted[count - 1]));
    }
    result.rows.push_back(std::move(row));
  }
  return result;
}

void add(std::vector<std::string>& row, const Estimate& estimate) {
  for (const double value : {estimate.value, estimate.interval.low, estimate.interval.high})
    row.push_back(std::isnan(value) ? "-" : fmt::format("{:.4f}", value));
}

std::string left_out_note(const std::vector<OutputColumn>& outputs,
                          const std::vector<Sensitivity>& sensitivity, std::uint64_t samples) {
  std::string note;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (sensitivity[k].left_out > 0)
      note += fmt::format("{}{} of {} samples of {}",
                          note.empty() ? "Omitted because of failed rows: " : ", ",
                          sensitivity[k].left_out, samples, outputs[k].name);
  return note.empty() ? note : note + ".";
}

ResultTable sobol_table() {
  ResultTable table;
  table.name = "sobol indices";
  table.title = "Sobol' indices: shares of the variance, with 95 % confidence";
  table.columns = {{"output", ""}, {"parameter", ""}, {"first order", ""}, {"from", ""},
                   {"to", ""},     {"total", ""},     {"from", ""},        {"to", ""}};
  table.notes = {
      "First order: of the parameter by itself; total: with all interactions. Saltelli "
      "et al. (2010) and Jansen, confidence by bootstrap."};
  return table;
}

ResultTable shapley_table() {
  ResultTable table;
  table.name = "shapley effects";
  table.title = "Shapley effects: shares of the variance that sum to 1, with 95 % confidence";
  table.columns = {{"output", ""}, {"parameter", ""}, {"effect", ""}, {"from", ""}, {"to", ""}};
  table.notes = {
      "Also valid for correlated parameters. Song, Nelson and Staum (2016), confidence by "
      "bootstrap."};
  return table;
}

/// Table with a row for each output and parameter.
ResultTable sensitivity_table(const SweepRows& sweep, const std::vector<OutputColumn>& outputs,
                              const std::vector<Sensitivity>& sensitivity) {
  const bool is_sobol = sweep.section().plan == SweepPlan::sobol_indices;
  ResultTable table = is_sobol ? sobol_table() : shapley_table();
  const std::vector<SweepParameter>& parameters = sweep.section().parameters;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      std::vector<std::string> row = {outputs[k].name, parameters[i].name};
      if (i < sensitivity[k].sobol.size()) {
        add(row, sensitivity[k].sobol[i].first);
        add(row, sensitivity[k].sobol[i].total);
      }
      if (i < sensitivity[k].shapley.size()) add(row, sensitivity[k].shapley[i]);
      row.resize(table.columns.size(), "-");
      table.rows.push_back(std::move(row));
    }
  }
  const std::string note =
      left_out_note(outputs, sensitivity, sweep.count() / sweep.rows_per_sample());
  if (!note.empty()) table.notes.push_back(note);
  return table;
}

ResultTable failure_table(const SweepTable& table) {
  ResultTable result;
  result.name = "failures";
  result.title = "Rows without some or all outputs";
  result.columns = {{"rows", ""}, {"why", ""}};
  for (const auto& [reason, rows] : table.reasons)
    result.rows.push_back({std::to_string(rows), reason});
  std::stable_sort(result.rows.begin(), result.rows.end(), [](const auto& a, const auto& b) {
    return std::stoull(a[0]) > std::stoull(b[0]);
  });
  constexpr std::size_t kShown = 20;
  if (result.rows.size() > kShown) {
    result.rows.resize(kShown);
    result.notes = {"The most frequent reasons; sweep.csv has that of each row."};
  }
  return result;
}

}  // namespace

std::vector<Sensitivity> sensitivities(const SweepRows& sweep, const SweepTable& table) {
  std::vector<Sensitivity> result;
  for (Index k = 0; k < table.figures.rows(); ++k)
    result.push_back(sensitivity_of(sweep, table.figures.row(k)));
  return result;
}

std::vector<ResultTable> sweep_tables(const SweepRows& sweep,
                                      const std::vector<OutputColumn>& outputs,
                                      const SweepTable& table,
                                      const std::vector<Sensitivity>& sensitivity) {
  std::vector<ResultTable> tables;
  if (!outputs.empty()) tables.push_back(percentile_table(outputs, table));
  const SweepPlan plan = sweep.section().plan;
  if (!outputs.empty() && (plan == SweepPlan::sobol_indices || plan == SweepPlan::shapley))
    tables.push_back(sensitivity_table(sweep, outputs, sensitivity));
  if (table.failed > 0) tables.push_back(failure_table(table));
  return tables;
}

}  // namespace flexneck::pipeline
