// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/corridor_table.h"

#include <string>
#include <utility>

#include "geometry/foundation/output_file.h"
#include "pipeline/language/study/curve_table.h"

namespace flexneck::pipeline {

namespace {

Curve listed_curve(const StudyTable& table, const char* key, const std::vector<double>& times_s) {
  const std::vector<double> values = table.numbers(key, times_s.size());
  const auto count = static_cast<Eigen::Index>(times_s.size());
  return {"", key, table.text("unit"), Eigen::VectorXd::Map(times_s.data(), count),
          Eigen::VectorXd::Map(values.data(), count)};
}

CurveCorridor listed_corridor(const StudyTable& table) {
  const std::vector<double> times_s = table.quantities("times");
  if (times_s.size() < 2) table.refuse("times", "expected at least two times");
  for (std::size_t k = 1; k < times_s.size(); ++k)
    if (!(times_s[k] > times_s[k - 1])) table.refuse("times", "expected times that increase");
  if (!table.has("unit")) table.refuse("unit", "expected the unit of lower and upper");
  return {listed_curve(table, "lower", times_s), listed_curve(table, "upper", times_s)};
}

}  // namespace

CurveCorridor read_corridor(const StudyTable& table) {
  CurveCorridor corridor;
  if (table.has("table")) {
    table.refuse_given({"times", "lower", "upper"},
                       "is given both by this key and by the key 'table'; remove one of them");
    corridor = {read_curve_column(table, "lower"), read_curve_column(table, "upper")};
    corridor.upper = in_unit(std::move(corridor.upper), corridor.lower.unit);
  } else {
    corridor = listed_corridor(table);
  }
  const Eigen::VectorXd width = corridor.upper.values - corridor.lower.values;
  Eigen::Index where = 0;
  if (width.minCoeff(&where) < 0)
    table.refuse(table.has("table") ? "table" : "upper",
                 "the corridor crosses itself: upper is below lower at " +
                     rounded_text(corridor.lower.time_s[where]) + " s");
  return corridor;
}

}  // namespace flexneck::pipeline
