// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/measured_section.h"

#include <array>
#include <cmath>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/document/channel_class.h"
#include "pipeline/isolation/result_files.h"
#include "pipeline/model/model_sections.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> figures() { return {"peak", "time of peak", "first zero crossing"}; }

constexpr Key kCurveKeys[] = {
    Key::text("channel", kRequired, "Channel of the case's run that was measured"),
    Key::file(
        "table", kRequired,
        "CSV file: its first line \"time [ms],angle [deg]\", or two columns without names; or a "
        "test of ISO-MME: its folder, its .mme or a channel's file"),
    Key::text("column", kNone,
              "Column of that file, where it has more than two; code of the test's channel"),
    Key::text("unit", kNone, "Unit of the values, where the file names none"),
    Key::text("filter", kNone,
              "Channel class that the values are filtered by, unless their ISO-MME code says that "
              "they are; "
              "none if not there",
              {.choices = channel_class_names}),
    Key::quantity("time_zero", "s", "0", "Time in the file that is the case's zero"),
    Key::quantity("from", "s", kNone, "Time of the case from which the curve is rated"),
    Key::quantity("to", "s", kNone, "Time of the case up to which it is"),
};

constexpr Key kCorridorKeys[] = {
    Key::text("channel", kRequired, "Channel of the case's run"),
    Key::file("table", kNone,
              "CSV file with the columns \"lower\" and \"upper\"; in place of times, lower, upper"),
    Key::quantities("times", "s", kNone, "Times of the corridor, linear between them"),
    Key::numbers("lower", kNone, "Least value at each time"),
    Key::numbers("upper", kNone, "Largest value at each time"),
    Key::text("unit", kNone, "Unit of the values, where no file names it"),
};

constexpr Key kLimitKeys[] = {
    Key::text("channel", kRequired, "Channel of the case's run"),
    Key::text("figure", kRequired, "What of the channel is limited", {.choices = figures}),
    Key::text("low", kNone, "Least value with its unit, such as \"64 deg\""),
    Key::text("high", kNone, "Largest value with its unit"),
};

constexpr Key kMeasuredKeys[] = {
    Key::tables("curve", "Measured curves", kCurveKeys),
    Key::tables("corridor", "Where curves should run", kCorridorKeys),
    Key::tables("limit", "Where peaks, their times and zero crossings should lie", kLimitKeys),
};

/// The unit of the file, or of the key where the file names none.
void set_unit(const StudyTable& table, Curve& curve) {
  const std::string unit = table.text("unit");
  if (!unit.empty() && !curve.unit.empty())
    table.refuse("unit",
                 "the file names the unit '" + curve.unit + "' already; leave this key out");
  if (unit.empty() && curve.unit.empty())
    table.refuse("unit", "expected this key, since " + curve.label() + " names no unit");
  if (!unit.empty()) curve.unit = unit;
}

/// The interval of samples that a filter can take.
double sample_interval_s(const Curve& curve) {
  const Eigen::Index n = curve.time_s.size();
  const double interval_s = (curve.time_s[n - 1] - curve.time_s[0]) / static_cast<double>(n - 1);
  const Eigen::VectorXd steps = curve.time_s.tail(n - 1) - curve.time_s.head(n - 1);
  constexpr double kEven = 0.01;
  if ((steps.array() - interval_s).abs().maxCoeff() > kEven * interval_s)
    throw InputError("a filter needs samples at equal intervals, which " + curve.label() +
                     " has not");
  return interval_s;
}

Curve read_file(const StudyTable& table, const std::string& column, std::vector<InputFile>& files) {
  const std::filesystem::path path = table.file("table");
  Curve curve = read_curve(path, column);
  files.push_back({curve.source.filename().string(), hash_of_file(curve.source.string())});
  set_unit(table, curve);
  return curve;
}

/// By the key "filter".
void filter_as_asked(const StudyTable& table, Curve& curve) {
  const multibody::ChannelClass wanted = read_channel_class(table, "filter");
  at_key(table, "filter", [&] {
    if (needs_filter(curve, wanted))
      curve.values = multibody::cfc_filtered(curve.values, sample_interval_s(curve), wanted);
    return true;
  });
  if (curve.filter) curve.filter = mme_filter(std::string(1, mme_filter_letter(name_of(wanted))));
}

MeasuredCurve read_measured_curve(const StudyTable& table, std::vector<InputFile>& files) {
  MeasuredCurve measured;
  measured.channel = table.text("channel");
  measured.curve = read_file(table, table.text("column"), files);
  Curve& curve = measured.curve;
  if (table.has("filter")) filter_as_asked(table, curve);
  curve.time_s.array() -= table.quantity("time_zero");
  if (table.has("from")) measured.from_s = table.quantity("from");
  if (table.has("to")) measured.to_s = table.quantity("to");
  table.finish();
  return measured;
}

Curve listed_curve(const StudyTable& table, const char* key, const std::vector<double>& times_s) {
  const std::vector<double> values = table.numbers(key, times_s.size());
  const auto count = static_cast<Eigen::Index>(times_s.size());
  return {"", key, table.text("unit"), Eigen::VectorXd::Map(times_s.data(), count),
          Eigen::VectorXd::Map(values.data(), count)};
}

MeasuredCorridor listed_corridor(const StudyTable& table) {
  const std::vector<double> times_s = table.quantities("times");
  if (times_s.size() < 2) table.refuse("times", "expected two times or more");
  for (std::size_t k = 1; k < times_s.size(); ++k)
    if (!(times_s[k] > times_s[k - 1])) table.refuse("times", "expected times that increase");
  if (!table.has("unit")) table.refuse("unit", "expected the unit of lower and upper");
  return {"", listed_curve(table, "lower", times_s), listed_curve(table, "upper", times_s)};
}

MeasuredCorridor read_corridor(const StudyTable& table, std::vector<InputFile>& files) {
  MeasuredCorridor corridor;
  if (table.has("table")) {
    table.refuse_given({"times", "lower", "upper"}, "is given twice, here and by the key 'table'");
    corridor = {"", read_file(table, "lower", files), read_file(table, "upper", files)};
    files.pop_back();
    corridor.upper = in_unit(std::move(corridor.upper), corridor.lower.unit);
  } else {
    corridor = listed_corridor(table);
  }
  corridor.channel = table.text("channel");
  const Eigen::VectorXd width = corridor.upper.values - corridor.lower.values;
  Eigen::Index where = 0;
  if (width.minCoeff(&where) < 0)
    table.refuse(table.has("table") ? "table" : "upper",
                 "the corridor crosses itself: upper is below lower at " +
                     std::to_string(corridor.lower.time_s[where]) + " s");
  table.finish();
  return corridor;
}

MeasuredLimit read_limit(const StudyTable& table) {
  MeasuredLimit limit{table.text("channel"),
                      static_cast<MeasuredLimit::Figure>(table.choice("figure")), table.text("low"),
                      table.text("high"), table};
  if (limit.low.empty() && limit.high.empty()) table.refuse("low", "expected low or high, or both");
  table.finish();
  return limit;
}

}  // namespace

std::span<const Key> measured_keys() { return kMeasuredKeys; }

MeasuredTest read_measured(const StudyTable& test, std::vector<InputFile>& files) {
  MeasuredTest measured;
  for (const StudyTable& table : test.tables("curve"))
    measured.curves.push_back(read_measured_curve(table, files));
  for (const StudyTable& table : test.tables("corridor"))
    measured.corridors.push_back(read_corridor(table, files));
  for (const StudyTable& table : test.tables("limit")) measured.limits.push_back(read_limit(table));
  return measured;
}

}  // namespace flexneck::pipeline
