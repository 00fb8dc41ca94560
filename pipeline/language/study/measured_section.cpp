// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/measured_section.h"

#include "pipeline/language/study/curve_table.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> figures() { return {"peak", "time of peak", "first zero crossing"}; }

constexpr auto kCurveKeys = joined(
    std::to_array<Key>({
        Key::text("channel", kRequired,
                  "Channel of the case's run that corresponds to the measured curve"),
        curve_file_key(kRequired),
        Key::quantity("from", "s", kNone, "Start of the rated interval, in the time of the case"),
        Key::quantity("to", "s", kNone, "End of the rated interval"),
    }),
    kCurveTableKeys);

constexpr auto kMeasuredCorridorKeys =
    joined(std::to_array<Key>({Key::text("channel", kRequired, "Channel of the case's run")}),
           kCorridorKeys);

constexpr Key kLimitKeys[] = {
    Key::text("channel", kRequired, "Channel of the case's run"),
    Key::text("figure", kRequired, "Quantity of the channel that is limited", {.choices = figures}),
    Key::text("low", kNone, "Lower limit with its unit, such as \"64 deg\""),
    Key::text("high", kNone, "Upper limit with its unit"),
};

constexpr Key kMeasuredKeys[] = {
    Key::tables("curve", "Measured curves against which computed ones are rated", kCurveKeys),
    Key::tables("corridor", "Corridors in which computed curves should lie", kMeasuredCorridorKeys),
    Key::tables("limit", "Limits of peaks, their times and zero crossings", kLimitKeys),
};

MeasuredCurve read_measured_curve(const StudyTable& table) {
  MeasuredCurve measured;
  measured.channel = table.text("channel");
  measured.curve = read_curve_table(table);
  if (table.has("from")) measured.from_s = table.quantity("from");
  if (table.has("to")) measured.to_s = table.quantity("to");
  table.finish();
  return measured;
}

MeasuredCorridor read_measured_corridor(const StudyTable& table) {
  MeasuredCorridor measured{read_corridor(table), table.text("channel")};
  table.finish();
  return measured;
}

MeasuredLimit read_limit(const StudyTable& table) {
  MeasuredLimit limit{table.text("channel"),
                      static_cast<MeasuredLimit::Figure>(table.choice("figure")), table.text("low"),
                      table.text("high"), table};
  if (limit.low.empty() && limit.high.empty())
    table.refuse("low", "expected low, high or both, found neither");
  table.finish();
  return limit;
}

}  // namespace

std::span<const Key> measured_keys() { return kMeasuredKeys; }

MeasuredTest read_measured(const StudyTable& test) {
  MeasuredTest measured;
  for (const StudyTable& table : test.tables("curve"))
    measured.curves.push_back(read_measured_curve(table));
  for (const StudyTable& table : test.tables("corridor"))
    measured.corridors.push_back(read_measured_corridor(table));
  for (const StudyTable& table : test.tables("limit")) measured.limits.push_back(read_limit(table));
  return measured;
}

}  // namespace flexneck::pipeline
