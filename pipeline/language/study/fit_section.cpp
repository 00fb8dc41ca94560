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
    Key::text("name", kNone, "What tables call it; the key if it is not there"),
    Key::text(
        "key", kRequired,
        "Dotted key of the study that is free, such as body.neck.damping_ratio or variables.x"),
    Key::text("unit", kNone, "Unit of the numbers of this parameter; none for pure numbers"),
    Key::number("from", kRequired, "Least value"),
    Key::number("to", kRequired, "Largest value"),
    Key::number("start", kNone, "Where the first fit begins; the study's value if not there"),
    Key::number("mean", kNone, "Of a normal prior; without it the prior is uniform"),
    Key::number("standard_deviation", kNone, "Of a normal prior", {.range = kPositive}),
};

constexpr auto kTargetKeys = joined(
    std::to_array<Key>({
        Key::text("name", kNone, "What tables call it; the output if it is not there"),
        Key::text("output", kNone, "A figure, such as modes.mass; or a curve:"),
        Key::text("curve", kNone, "A curve, such as pendulum.flexion-60.head rotation"),
        Key::text("expression", kNone,
                  "Of the parameters by their names, each a number in its unit, such as \"top - "
                  "base\": with low = \"0\" and must_hold an inequality between them"),
        Key::text("value", kNone, "What the figure should be, with its unit, such as \"36.1 Hz\""),
        Key::text("standard_deviation", kNone,
                  "Of the value or of each point of the curve, with unit"),
        Key::number("relative_deviation", kNone, "In its place: a share of the value",
                    {.range = kPositive}),
        Key::text("low", kNone, "Of a window: the least value, all within it being equally good"),
        Key::text("high", kNone, "Of a window: the largest value"),
        Key::text(
            "smoothing", kNone,
            "How far outside a window counts as one standard deviation while fitting; a tenth of "
            "the window if not there"),
        curve_file_key(kNone),
        Key::table("corridor", "In place of the table: where the curve should run", kCorridorKeys),
        Key::quantity("from", "s", kNone,
                      "Time from which the curve counts; its first if not there"),
        Key::quantity("to", "s", kNone, "Time up to which it counts; its last if not there"),
        Key::count("points", "50", "Equally spaced points as which the curve counts, independent",
                   {.range = {.low = 2, .high = 10000}}),
        Key::text("rating", kNone, "The curve's rating is the target, its value 1 as a rule",
                  {.choices = ratings}),
        Key::flag("must_hold", "false",
                  "Whether fits keep to a window; it then adds nothing to chi-squared"),
        Key::flag("held_out", "false", "Whether the target is predicted only, not fitted"),
    }),
    kCurveTableKeys);

constexpr Key kFitKeys[] = {
    Key::count("starts", "8", "Fits from different places: the study's own, then Sobol' points",
               {.range = {.low = 1, .high = 10000}}),
    Key::count("seed", "1", "Of the random numbers", {.range = at_least(0)}),
    Key::text("method", "local",
              "Whether least squares begin at the starts, or where a global search from each ends",
              {.choices = methods}),
    Key::count("evaluations", "1000", "Of the model in each global search, at most",
               {.range = at_least(1)}),
    Key::count("iterations", "40", "Steps of each fit, at most", {.range = at_least(1)}),
    Key::flag("profiles", "true", "Whether confidence is found by profile likelihood, too"),
    Key::count("history_samples", "0",
               "Random points of the prior that are tried against all targets",
               {.range = {.low = 0, .high = 1'000'000'000}}),
    Key::number("history_deviations", "3",
                "Standard deviations within which a point meets a value there",
                {.range = kPositive}),
    Key::texts("choices", kNone, "Sentences: what was chosen with the targets in sight"),
    Key::tables("parameter", "What is free", kParameterKeys),
    Key::tables("target", "What should come out", kTargetKeys),
};

FitParameter read_parameter(const StudyTable& table) {
  FitParameter parameter;
  parameter.key = table.text("key");
  parameter.name = table.text("name");
  if (parameter.name.empty()) parameter.name = parameter.key;
  parameter.unit = table.text("unit");
  parameter.from = table.number("from");
  parameter.to = table.number("to");
  if (!(parameter.from < parameter.to)) table.refuse("to", "expected more than from");
  if (table.has("start")) {
    parameter.start = table.number("start");
    if (!(parameter.from <= *parameter.start && *parameter.start <= parameter.to))
      table.refuse("start", "expected a value between from and to, the bounds exclude it");
  }
  if (table.has("mean") != table.has("standard_deviation"))
    table.refuse(table.has("mean") ? "mean" : "standard_deviation",
                 "expected mean and standard_deviation of a normal prior, found one of them");
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
                       "expected none beside a corridor");
    const StudyTable corridor = table.table("corridor");
    curve.corridor = read_corridor(corridor);
    corridor.finish();
    return curve.corridor->lower.time_s;
  }
  if (!table.has("table")) table.refuse("table", "expected the file of the curve, or a corridor");
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
      table.refuse(key, "expected a time that " + what + " covers, which has " +
                            exact_text(first_s) + " s to " + exact_text(last_s) + " s");
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
    table.refuse_given({"value", "standard_deviation", "relative_deviation", "low", "high"},
                       "expected none of a corridor, which is a window at each of its points");
    return;
  }
  if (target.curve && !target.curve->rating) {
    table.refuse_given({"value", "relative_deviation", "low", "high", "smoothing"},
                       "expected none of a curve, which has its values in its table and a "
                       "standard_deviation");
    if (target.standard_deviation.empty())
      table.refuse("standard_deviation", "expected that of each point of the curve");
    return;
  }
  if (target.is_window()) {
    table.refuse_given({"value", "standard_deviation", "relative_deviation"},
                       "expected a value with its deviation or a window, found both");
    if ((target.low.empty() || target.high.empty()) && target.smoothing.empty())
      table.refuse("smoothing", "expected this key of a window that is open on one side");
    return;
  }
  if (target.value.empty()) table.refuse("value", "expected a value, or low or high of a window");
  if (target.standard_deviation.empty() != target.relative_deviation.has_value())
    table.refuse("standard_deviation", "expected one of standard_deviation and relative_deviation");
  table.refuse_given({"smoothing"}, "expected of a window only");
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
    table.refuse("output", "expected one of output, curve and expression");
  if (table.has("curve")) {
    target.curve = read_fit_curve(table);
  } else {
    table.refuse_given({"table", "corridor", "column", "unit", "filter", "time_zero", "from", "to",
                        "points", "rating"},
                       "expected of a curve only");
  }
  if (target.name.empty()) {
    if (!target.expression.empty()) table.refuse("name", "expected one beside an expression");
    target.name = target.curve ? target.curve->output : target.output;
  }
  read_wanted(table, target);
  const bool is_window = target.is_window() || (target.curve && target.curve->corridor);
  if (target.must_hold && (!is_window || target.is_held_out))
    table.refuse("must_hold", "expected of a window or a corridor that is not held out");
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
    table.refuse_given({"evaluations"}, "expected with method = \"global\" only");
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
  if (fit.parameters.empty()) table.refuse("parameter", "expected at least one");
  check_names(names_of(fit.parameters), "fit.parameter");
  for (const StudyTable& each : table.tables("target")) fit.targets.push_back(read_target(each));
  if (std::all_of(fit.targets.begin(), fit.targets.end(),
                  [](const FitTarget& each) { return each.is_held_out || each.must_hold; }))
    table.refuse("target", "expected at least one that is not held out and counts");
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
                     "'flexneck keys study.fit' tells its keys");
  return read_fit(document.root().table(kFitSection));
}

}  // namespace flexneck::pipeline
