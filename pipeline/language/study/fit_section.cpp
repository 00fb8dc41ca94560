// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/fit_section.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/study/curve_table.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

namespace {

constexpr const char* kFitSection = "fit";

std::vector<std::string> methods() { return {"local", "global"}; }
std::vector<std::string> ratings() { return {"iso18571", "cora"}; }

constexpr Key kParameterKeys[] = {
    Key::text("name", kNone, "Name of the parameter in tables (default: the key)"),
    Key::text(
        "key", kRequired,
        "Dotted key of the study that is fitted, such as body.neck.damping_ratio or variables.x"),
    Key::text("unit", kNone, "Unit of the parameter's values (none for pure numbers)"),
    Key::number("from", kRequired, "Lower bound"),
    Key::number("to", kRequired, "Upper bound"),
    Key::number("start", kNone,
                "Starting value of the first fit (default: the value of the study)"),
    Key::number("mean", kNone, "Mean of a normal prior (default: a uniform prior)"),
    Key::number("standard_deviation", kNone, "Standard deviation of the normal prior",
                {.range = kPositive}),
};

constexpr auto kTargetKeys = joined(
    std::to_array<Key>({
        Key::text("name", kNone, "Name of the target in tables (default: the output)"),
        Key::text("output", kNone, "Figure that is fitted, such as modes.mass"),
        Key::text(
            "curve", kNone,
            "Instead of output: curve that is fitted, such as pendulum.flexion-60.head rotation"),
        Key::text("expression", kNone,
                  "Instead of output: expression of the parameters' names, each a number in its "
                  "unit, such as \"top - base\"; with low = \"0\" and must_hold it is an "
                  "inequality constraint"),
        Key::text("value", kNone, "Target value with its unit, such as \"36.1 Hz\""),
        Key::text("standard_deviation", kNone,
                  "Standard deviation of the value, or of each point of the curve, with its unit"),
        Key::number("relative_deviation", kNone,
                    "Instead of standard_deviation: standard deviation as a fraction of the value",
                    {.range = kPositive}),
        Key::text("low", kNone, "Lower limit of a window within which all values are equally good"),
        Key::text("high", kNone, "Upper limit of the window"),
        Key::text("smoothing", kNone,
                  "Distance outside a window that counts as one standard deviation (default: a "
                  "tenth of the window's width)"),
        curve_file_key(kNone),
        Key::table("corridor", "Instead of a table: corridor in which the curve should lie",
                   kCorridorKeys),
        Key::quantity("from", "s", kNone,
                      "Start of the fitted interval (default: first time of the curve)"),
        Key::quantity("to", "s", kNone,
                      "End of the fitted interval (default: last time of the curve)"),
        Key::count("points", "50",
                   "Number of equally spaced, statistically independent points by which the curve "
                   "is represented",
                   {.range = {.low = 2, .high = 10000}}),
        Key::text("rating", kNone, "Use the curve's rating as the target, whose value is usually 1",
                  {.choices = ratings}),
        Key::flag("must_hold", "false",
                  "Treat the window as a constraint of the fit, which does not contribute to "
                  "chi-squared"),
        Key::flag("held_out", "false", "Only predict the target, do not fit it"),
    }),
    kCurveTableKeys);

constexpr Key kFitKeys[] = {
    Key::count("starts", "8",
               "Number of starting points: the values of the study, then Sobol' points",
               {.range = {.low = 1, .high = 10000}}),
    Key::count("seed", "1", "Seed of the random numbers", {.range = at_least(0)}),
    Key::text("method", "local",
              "local: least squares from each starting point; global: from the result of a global "
              "search at each starting point",
              {.choices = methods}),
    Key::count("evaluations", "1000", "Maximum number of model evaluations in each global search",
               {.range = at_least(1)}),
    Key::count("iterations", "40", "Maximum number of iterations of each fit",
               {.range = at_least(1)}),
    Key::flag("profiles", "true", "Also compute confidence intervals by profile likelihood"),
    Key::count("history_samples", "0",
               "Number of random points of the prior that are compared with all targets (history "
               "matching)",
               {.range = {.low = 0, .high = 1'000'000'000}}),
    Key::number("history_deviations", "3",
                "Number of standard deviations within which a point of the history matching meets "
                "a target value",
                {.range = kPositive}),
    Key::texts("choices", kNone, "Sentences on what was chosen with knowledge of the targets"),
    Key::tables("parameter", "Parameters that are fitted", kParameterKeys),
    Key::tables("target", "Targets of the fit", kTargetKeys),
};

FitParameter read_parameter(const StudyTable& table) {
  FitParameter parameter;
  parameter.key = table.text("key");
  parameter.name = table.text("name");
  if (parameter.name.empty()) parameter.name = parameter.key;
  parameter.unit = table.text("unit");
  parameter.from = table.number("from");
  parameter.to = table.number("to");
  if (!(parameter.from < parameter.to)) table.refuse("to", "expected a value above from");
  if (table.has("start")) {
    parameter.start = table.number("start");
    if (!(parameter.from <= *parameter.start && *parameter.start <= parameter.to))
      table.refuse("start", "expected a value between the bounds from and to");
  }
  if (table.has("mean") != table.has("standard_deviation"))
    table.refuse(
        table.has("mean") ? "mean" : "standard_deviation",
        "expected both mean and standard_deviation for a normal prior, found only one of them");
  if (table.has("mean")) {
    parameter.mean = table.number("mean");
    parameter.standard_deviation = table.number("standard_deviation");
    if (!(parameter.from <= *parameter.mean && *parameter.mean <= parameter.to))
      table.refuse("mean", "expected a value between from and to");
  }
  table.finish();
  return parameter;
}

/// Reads the wanted curve. @return the times that it covers
const Eigen::VectorXd& read_wanted_curve(const StudyTable& table, FitCurve& curve) {
  if (table.has("corridor")) {
    table.refuse_given({"table", "column", "unit", "filter", "time_zero", "rating"},
                       "has no effect beside a corridor; remove this key");
    const StudyTable corridor = table.table("corridor");
    curve.corridor = read_corridor(corridor);
    corridor.finish();
    return curve.corridor->lower.time_s;
  }
  if (!table.has("table"))
    table.refuse("table", "expected the file of the curve or a corridor, found neither");
  curve.target = read_curve_table(table);
  return curve.target.time_s;
}

FitCurve read_fit_curve(const StudyTable& table) {
  FitCurve curve;
  curve.output = table.text("curve");
  const Eigen::VectorXd& time_s = read_wanted_curve(table, curve);
  const double first_s = time_s[0];
  const double last_s = time_s[time_s.size() - 1];
  curve.from_s = table.has("from") ? table.quantity("from") : first_s;
  curve.to_s = table.has("to") ? table.quantity("to") : last_s;
  if (!(curve.from_s < curve.to_s)) table.refuse("to", "expected a time after from");
  const std::string what = curve.corridor ? "the corridor" : curve.target.label();
  for (const auto& [key, is_missing] :
       {std::pair{"from", curve.from_s < first_s}, std::pair{"to", curve.to_s > last_s}})
    if (is_missing)
      table.refuse(key, "expected a time within those of " + what + ", " + exact_text(first_s) +
                            " s to " + exact_text(last_s) + " s");
  curve.points = table.count("points");
  if (table.has("rating")) curve.rating = table.choice("rating");
  return curve;
}

/// Reads a wanted value with its deviation, or a window.
void read_wanted(const StudyTable& table, FitTarget& target) {
  target.value = table.text("value");
  target.low = table.text("low");
  target.high = table.text("high");
  target.standard_deviation = table.text("standard_deviation");
  target.smoothing = table.text("smoothing");
  if (table.has("relative_deviation"))
    target.relative_deviation = table.number("relative_deviation");
  if (target.curve && target.curve->corridor) {
    table.refuse_given(
        {"value", "standard_deviation", "relative_deviation", "low", "high"},
        "has no effect on a corridor, which is a window at each of its points; remove this key");
    return;
  }
  if (target.curve && !target.curve->rating) {
    table.refuse_given({"value", "relative_deviation", "low", "high", "smoothing"},
                       "has no effect on a curve, which is given by a table and a "
                       "standard_deviation; remove this key");
    if (target.standard_deviation.empty())
      table.refuse("standard_deviation",
                   "expected the standard deviation of each point of the curve, found none");
    return;
  }
  if (target.is_window()) {
    table.refuse_given({"value", "standard_deviation", "relative_deviation"},
                       "expected either a value with its deviation or a window, found both");
    if ((target.low.empty() || target.high.empty()) && target.smoothing.empty())
      table.refuse("smoothing", "expected this key for a window with one limit, found none");
    return;
  }
  if (target.value.empty())
    table.refuse("value", "expected a value, or low and high of a window, found none of them");
  if (target.standard_deviation.empty() != target.relative_deviation.has_value())
    table.refuse("standard_deviation",
                 "expected exactly one of standard_deviation and relative_deviation");
  table.refuse_given({"smoothing"}, "has an effect only on a window; remove this key");
}

FitTarget read_target(const StudyTable& table) {
  FitTarget target{.name = table.text("name"),
                   .output = table.text("output"),
                   .expression = table.text("expression"),
                   .curve = {},
                   .value = {},
                   .standard_deviation = {},
                   .relative_deviation = {},
                   .low = {},
                   .high = {},
                   .smoothing = {},
                   .is_held_out = table.flag("held_out"),
                   .must_hold = table.flag("must_hold"),
                   .table = table};
  if (table.has("output") + table.has("curve") + table.has("expression") != 1)
    table.refuse("output", "expected exactly one of output, curve and expression");
  if (table.has("curve")) {
    target.curve = read_fit_curve(table);
  } else {
    table.refuse_given({"table", "corridor", "column", "unit", "filter", "time_zero", "from", "to",
                        "points", "rating"},
                       "has an effect only on a curve; remove this key");
  }
  if (target.name.empty()) {
    if (!target.expression.empty())
      table.refuse("name", "expected a name for an expression, found none");
    target.name = target.curve ? target.curve->output : target.output;
  }
  read_wanted(table, target);
  const bool is_window = target.is_window() || (target.curve && target.curve->corridor);
  if (target.must_hold && (!is_window || target.is_held_out))
    table.refuse("must_hold", "expected only for a window or a corridor that is not held out");
  table.finish();
  return target;
}

}  // namespace

std::span<const Key> fit_keys() { return kFitKeys; }

FitSection read_fit(const StudyTable& table) {
  FitSection fit;
  fit.starts = table.count("starts");
  fit.seed = table.count("seed");
  fit.method = static_cast<FitSection::Method>(table.choice("method"));
  if (fit.method == FitSection::Method::local)
    table.refuse_given({"evaluations"},
                       "has an effect only with method = \"global\"; remove this key");
  fit.evaluations = table.count("evaluations");
  fit.iterations = table.count("iterations");
  fit.has_profiles = table.flag("profiles");
  fit.history_samples = table.count("history_samples");
  if (fit.history_samples == 0)
    table.refuse_given({"history_deviations"}, "has no effect without history_samples");
  fit.history_deviations = table.number("history_deviations");
  fit.choices = table.texts("choices");
  for (const StudyTable& each : table.tables("parameter"))
    fit.parameters.push_back(read_parameter(each));
  if (fit.parameters.empty()) table.refuse("parameter", "expected at least one parameter");
  check_names(names_of(fit.parameters), "fit.parameter");
  for (const StudyTable& each : table.tables("target")) fit.targets.push_back(read_target(each));
  if (std::all_of(fit.targets.begin(), fit.targets.end(),
                  [](const FitTarget& each) { return each.is_held_out || each.must_hold; }))
    table.refuse("target",
                 "expected at least one target that contributes to chi-squared, found only those "
                 "with held_out or must_hold");
  check_names(names_of(fit.targets), "fit.target");
  table.finish();
  return fit;
}

FitSection read_fit(const std::filesystem::path& study, const std::vector<std::string>& settings) {
  FilesRead reads;
  const StudyDocument document(study, settings, study_keys());
  reads.forget();  // the values identify the study; files of targets are recorded
  if (!document.root().has(kFitSection))
    throw InputError(study.string() +
                     ": expected [fit] with [[fit.parameter]] and [[fit.target]], found none; "
                     "'flexneck keys study.fit' lists the keys");
  return read_fit(document.root().table(kFitSection));
}

}  // namespace flexneck::pipeline
