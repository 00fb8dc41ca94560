// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/sweep_section.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

namespace {

using Kind = SweepDistribution::Kind;

std::vector<std::string> kind_names() {
  return {"uniform", "log_uniform", "normal", "lognormal", "triangular", "discrete"};
}

constexpr Key kParameterKeys[] = {
    Key::text("name", kNone, "Name of the parameter's column (default: the key)"),
    Key::text(
        "key", kRequired,
        "Dotted key of the study that is varied, such as body.neck.damping_ratio or variables.x"),
    Key::text("unit", kNone, "Unit of the parameter's values (none for pure numbers)"),
    Key::numbers("values", kNone, "Values of the parameter"),
    Key::texts("texts", kNone, "Instead of values: texts, written as for --set"),
    Key::number("from", kNone, "Lowest value, for equal steps or a distribution"),
    Key::number("to", kNone, "Highest value, for equal steps or a distribution"),
    Key::count("steps", kNone, "Number of equally spaced values from the lowest to the highest",
               {.range = at_least(2)}),
    Key::text("distribution", kNone, "Distribution of the samples (discrete requires values)",
              {.choices = kind_names}),
    Key::number("mode", kNone, "Most likely value of a triangular distribution"),
    Key::number("mean", kNone, "Mean of a normal or lognormal distribution"),
    Key::number("standard_deviation", kNone,
                "Standard deviation of a normal or lognormal distribution; a normal one may be "
                "truncated by from and to",
                {.range = kPositive}),
    Key::numbers("weights", kNone,
                 "Weights of the values of a discrete distribution (default: equal)",
                 {.range = at_least(0)}),
};

constexpr Key kCorrelationKeys[] = {
    Key::texts("of", kNone, "Names of the two correlated parameters"),
    Key::number("coefficient", kRequired, "Correlation coefficient of their normal scores",
                {.range = {.low = -1, .high = 1}}),
};

constexpr Key kSweepKeys[] = {
    Key::text("plan", "grid", "Sampling plan", {.choices = sweep_plan_names}),
    Key::count("samples", kNone, "Number of samples (not for a grid or a list)",
               {.range = at_least(1)}),
    Key::count("seed", "1", "Seed of the random numbers", {.range = at_least(0)}),
    Key::texts("outputs", kNone, "Figures to tabulate, such as pendulum.flexion-60.head_rotation"),
    Key::texts(
        "curves", kNone,
        "Curves whose percentile bands are computed, such as pendulum.flexion-60.head rotation"),
    Key::tables("parameter", "Parameters that are varied", kParameterKeys),
    Key::tables("correlation", "Correlations of parameters", kCorrelationKeys),
};

std::vector<double> equal_steps(double from, double to, int steps) {
  std::vector<double> values;
  for (int k = 0; k < steps; ++k) {
    const double share = static_cast<double>(k) / (steps - 1);
    values.push_back((1 - share) * from + share * to);
  }
  return values;
}

void read_levels(const StudyTable& table, SweepParameter& parameter) {
  if (table.has("values")) {
    table.refuse_given({"texts", "steps"}, "expected only one of values, texts and steps");
    parameter.values = table.numbers("values");
    if (parameter.values.empty()) table.refuse("values", "expected at least one number");
  } else if (table.has("texts")) {
    table.refuse_given({"steps"}, "expected only one of values, texts and steps");
    table.refuse_given({"unit"},
                       "has no effect on texts, which contain their own units; remove this key");
    parameter.texts = table.texts("texts");
    if (parameter.texts.empty()) table.refuse("texts", "expected at least one text");
  } else if (table.has("steps")) {
    parameter.values = equal_steps(table.number("from"), table.number("to"), table.count("steps"));
  }
}

std::vector<double> read_weights(const StudyTable& table, std::size_t count) {
  if (!table.has("weights")) return std::vector<double>(count, 1.0 / static_cast<double>(count));
  std::vector<double> weights = table.numbers("weights", count);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) table.refuse("weights", "expected weights whose sum is positive");
  for (double& weight : weights) weight /= sum;
  return weights;
}

void check_normal(const StudyTable& table, const SweepDistribution& found) {
  if (found.kind == Kind::lognormal && !(found.mean > 0))
    table.refuse("mean", "expected a positive mean for a lognormal distribution");
  // Further out the quantiles cannot be distinguished in floating point.
  constexpr double kFarthest = 8;
  const double center = found.mean;
  const double reach = kFarthest * found.standard_deviation;
  if (found.kind == Kind::normal && !(found.low < center + reach && found.high > center - reach))
    table.refuse(table.has("from") ? "from" : "to",
                 "expected a value within 8 standard deviations of the mean");
  if (found.kind == Kind::lognormal)
    table.refuse_given({"from", "to"},
                       "not supported for a lognormal distribution; remove this key");
}

SweepDistribution read_distribution(const StudyTable& table) {
  SweepDistribution found;
  found.kind = static_cast<Kind>(table.choice("distribution"));
  const bool is_normal = found.kind == Kind::normal || found.kind == Kind::lognormal;
  if (is_normal) {
    found.mean = table.number("mean");
    found.standard_deviation = table.number("standard_deviation");
  } else {
    table.refuse_given(
        {"mean", "standard_deviation"},
        "has an effect only with a normal or lognormal distribution; remove this key");
  }
  if (!is_normal || table.has("from")) found.low = table.number("from");
  if (!is_normal || table.has("to")) found.high = table.number("to");
  if (!(found.low < found.high)) table.refuse("to", "expected a value above from");
  if (found.kind == Kind::log_uniform && !(found.low > 0))
    table.refuse("from", "expected a positive value for a log_uniform distribution");
  if (is_normal) check_normal(table, found);
  if (found.kind == Kind::triangular) {
    found.mode = table.number("mode");
    if (!(found.low <= found.mode && found.mode <= found.high))
      table.refuse("mode", "expected a value between from and to");
  } else {
    table.refuse_given({"mode"},
                       "has an effect only with a triangular distribution; remove this key");
  }
  return found;
}

void read_sampled(const StudyTable& table, SweepParameter& parameter) {
  const bool is_discrete = !table.has("distribution") || table.text("distribution") == "discrete";
  if (is_discrete) {
    table.refuse_given({"mode", "mean", "standard_deviation"},
                       "has an effect only with a continuous distribution; remove this key");
    if (parameter.level_count() == 0)
      table.refuse("distribution", "expected a distribution, values or texts, found none");
    parameter.distribution.emplace().kind = Kind::discrete;
    parameter.distribution->weights = read_weights(table, parameter.level_count());
    return;
  }
  table.refuse_given({"values", "texts", "steps", "weights"},
                     "has an effect only with a discrete distribution; remove this key");
  parameter.distribution = read_distribution(table);
}

SweepParameter read_parameter(const StudyTable& table, bool is_sampled) {
  SweepParameter parameter;
  parameter.key = table.text("key");
  parameter.name = table.text("name");
  if (parameter.name.empty()) parameter.name = parameter.key;
  parameter.unit = table.text("unit");
  read_levels(table, parameter);
  if (is_sampled) {
    read_sampled(table, parameter);
  } else {
    table.refuse_given({"distribution", "mode", "mean", "standard_deviation", "weights"},
                       "has an effect only with a plan that takes samples, not with a grid or a "
                       "list; remove this key");
    if (parameter.level_count() == 0)
      table.refuse("values", "expected values, or texts, or from, to and steps");
  }
  if (parameter.level_count() > 0 && !table.has("steps"))
    table.refuse_given(
        {"from", "to"},
        "has an effect only with steps or a continuous distribution; remove this key");
  table.finish();
  return parameter;
}

SweepCorrelation read_correlation(const StudyTable& table,
                                  const std::vector<SweepParameter>& parameters) {
  SweepCorrelation correlation;
  const std::vector<std::string> names = table.texts("of");
  if (names.size() != 2 || names[0] == names[1])
    table.refuse("of", "expected the names of two different parameters");
  for (std::size_t k = 0; k < 2; ++k) {
    try {
      correlation.parameters[k] = find_name(names_of(parameters), names[k], "parameter");
    } catch (const InputError& error) {
      table.refuse("of", error.what());
    }
    if (!parameters[correlation.parameters[k]].is_continuous())
      table.refuse("of", "expected parameters with continuous distributions, but '" + names[k] +
                             "' has single values");
  }
  correlation.coefficient = table.number("coefficient");
  table.finish();
  return correlation;
}

void check_plan(const StudyTable& table, const SweepSection& sweep) {
  const std::size_t length = sweep.parameters.front().level_count();
  for (const SweepParameter& each : sweep.parameters)
    if (sweep.plan == SweepPlan::list && each.level_count() != length)
      table.refuse("parameter",
                   "expected the same number of values for all parameters of a list, found " +
                       std::to_string(length) + " of '" + sweep.parameters.front().name + "' and " +
                       std::to_string(each.level_count()) + " of '" + each.name + "'");
  if (sweep.plan == SweepPlan::sobol_indices && !sweep.correlations.empty())
    table.refuse("correlation",
                 "expected independent parameters for the plan sobol_indices; use the plan shapley "
                 "for correlated ones");
  if (sweep.plan == SweepPlan::shapley && sweep.parameters.size() < 2)
    table.refuse("parameter", "expected at least two parameters for the plan shapley");
}

}  // namespace

std::vector<std::string> sweep_plan_names() {
  return {"grid", "list", "random", "latin_hypercube", "sobol", "sobol_indices", "shapley"};
}

std::span<const Key> sweep_keys() { return kSweepKeys; }

SweepSection read_sweep(const StudyTable& table) {
  SweepSection sweep;
  sweep.plan = static_cast<SweepPlan>(table.choice("plan"));
  const bool is_sampled = sweep.plan != SweepPlan::grid && sweep.plan != SweepPlan::list;
  if (is_sampled) {
    sweep.samples = table.count("samples");
  } else {
    table.refuse_given(
        {"samples"},
        "has no effect on a grid or a list, whose rows are given by the values of the parameters");
    table.refuse_given({"seed"}, "has no effect on a grid or a list, which are not random");
  }
  sweep.seed = table.count("seed");
  sweep.outputs = table.texts("outputs");
  sweep.curves = table.texts("curves");
  if (sweep.outputs.empty() && sweep.curves.empty())
    table.refuse("outputs", "expected at least one output or curve");
  for (const StudyTable& each : table.tables("parameter"))
    sweep.parameters.push_back(read_parameter(each, is_sampled));
  if (sweep.parameters.empty()) table.refuse("parameter", "expected at least one parameter");
  check_names(names_of(sweep.parameters), "sweep.parameter");
  for (const StudyTable& each : table.tables("correlation"))
    sweep.correlations.push_back(read_correlation(each, sweep.parameters));
  if (!is_sampled)
    table.refuse_given({"correlation"},
                       "has an effect only with a plan that takes samples; remove this key");
  check_plan(table, sweep);
  table.finish();
  return sweep;
}

SweepSection read_sweep(const std::filesystem::path& study,
                        const std::vector<std::string>& settings) {
  const StudyDocument document(study, settings, study_keys());
  if (!document.root().has("sweep"))
    throw InputError(study.string() +
                     ": expected [sweep] with a plan, outputs and [[sweep.parameter]], found none; "
                     "'flexneck keys study.sweep' lists the keys");
  return read_sweep(document.root().table("sweep"));
}

}  // namespace flexneck::pipeline
