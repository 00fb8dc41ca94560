// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/curve_table.h"

#include <cmath>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

namespace {

/// Sets the curve's unit: the file's, or the key's if the file names none.
void set_unit(const StudyTable& table, Curve& curve) {
  const std::string unit = table.text("unit");
  if (!unit.empty() && !curve.unit.empty())
    table.refuse("unit", "the file already gives the unit '" + curve.unit + "'; remove this key");
  if (unit.empty() && curve.unit.empty())
    table.refuse("unit", "expected this key, since " + curve.label() + " names no unit");
  if (!unit.empty()) curve.unit = unit;
}

/// Interval of samples, which a filter needs to be constant.
double sample_interval_s(const Curve& curve) {
  const Eigen::Index n = curve.time_s.size();
  const double interval_s = (curve.time_s[n - 1] - curve.time_s[0]) / static_cast<double>(n - 1);
  const Eigen::VectorXd steps = curve.time_s.tail(n - 1) - curve.time_s.head(n - 1);
  constexpr double kEven = 0.01;
  if ((steps.array() - interval_s).abs().maxCoeff() > kEven * interval_s)
    throw InputError(
        "expected samples at equal intervals, which the filter needs, found others in " +
        curve.label() + " has not");
  return interval_s;
}

/// Filters the curve by the key "filter".
void filter_as_asked(const StudyTable& table, Curve& curve) {
  const multibody::ChannelClass wanted = read_channel_class(table, "filter");
  at_key(table, "filter", [&] {
    if (needs_filter(curve, wanted))
      curve.values = multibody::cfc_filtered(curve.values, sample_interval_s(curve), wanted);
    return true;
  });
  if (curve.filter) curve.filter = mme_filter(std::string(1, mme_filter_letter(name_of(wanted))));
}

}  // namespace

Curve read_curve_column(const StudyTable& table, const std::string& column) {
  const std::filesystem::path path = table.file("table");
  Curve curve = read_curve(path, column);
  set_unit(table, curve);
  return curve;
}

Curve read_curve_table(const StudyTable& table) {
  Curve curve = read_curve_column(table, table.text("column"));
  if (table.has("filter")) filter_as_asked(table, curve);
  curve.time_s.array() -= table.quantity("time_zero");
  return curve;
}

}  // namespace flexneck::pipeline
