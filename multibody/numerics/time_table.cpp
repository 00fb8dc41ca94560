// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/time_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

void check_table(const std::vector<double>& times_s, const std::vector<double>& values) {
  if (times_s.size() != values.size()) {
    throw InputError("time table: " + std::to_string(times_s.size()) + " times but " +
                     std::to_string(values.size()) + " values; give as many of each");
  }
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (!std::isfinite(times_s[k]) || !std::isfinite(values[k])) {
      throw InputError("time table: row " + std::to_string(k + 1) + " is not finite");
    }
    if (k > 0 && !(times_s[k] > times_s[k - 1])) {
      throw InputError("time table: times must increase strictly, but row " +
                       std::to_string(k + 1) + " has " + exact_text(times_s[k]) + " s after " +
                       exact_text(times_s[k - 1]) + " s");
    }
  }
}

/// f(dt) = value + slope dt on one segment.
struct Line {
  double value;
  double slope;
  double integral(double dt) const { return (value + slope * dt / 2) * dt; }
  double second_integral(double dt) const { return (value / 2 + slope * dt / 6) * dt * dt; }
};

}  // namespace

TimeTable::TimeTable(std::vector<double> times_s, std::vector<double> values, Outside outside)
    : times_s_(std::move(times_s)), values_(std::move(values)), outside_(outside) {
  check_table(times_s_, values_);
  integrals_.assign(times_s_.size(), 0);
  second_integrals_.assign(times_s_.size(), 0);
  for (std::size_t k = 1; k < times_s_.size(); ++k) {
    const double dt = times_s_[k] - times_s_[k - 1];
    const Line line{values_[k - 1], (values_[k] - values_[k - 1]) / dt};
    integrals_[k] = integrals_[k - 1] + line.integral(dt);
    second_integrals_[k] =
        second_integrals_[k - 1] + integrals_[k - 1] * dt + line.second_integral(dt);
  }
}

TimeTable::Segment TimeTable::segment(double time_s) const {
  if (time_s > times_s_.back()) {
    return {times_s_.size() - 1, outside_ == Outside::constant ? values_.back() : 0, 0};
  }
  const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
  const auto k = static_cast<std::size_t>(after - times_s_.begin()) - 1;
  if (k + 1 == times_s_.size()) return {k, values_[k], 0};
  return {k, values_[k], (values_[k + 1] - values_[k]) / (times_s_[k + 1] - times_s_[k])};
}

double TimeTable::value(double time_s) const {
  if (times_s_.empty()) return 0;
  if (time_s < times_s_.front()) return outside_ == Outside::constant ? values_.front() : 0;
  const Segment at = segment(time_s);
  return at.value + at.slope * (time_s - times_s_[at.start]);
}

double TimeTable::integral(double time_s) const {
  if (times_s_.empty() || time_s <= times_s_.front()) return 0;
  const Segment at = segment(time_s);
  const double dt = time_s - times_s_[at.start];
  return integrals_[at.start] + Line{at.value, at.slope}.integral(dt);
}

double TimeTable::second_integral(double time_s) const {
  if (times_s_.empty() || time_s <= times_s_.front()) return 0;
  const Segment at = segment(time_s);
  const double dt = time_s - times_s_[at.start];
  return second_integrals_[at.start] + integrals_[at.start] * dt +
         Line{at.value, at.slope}.second_integral(dt);
}

}  // namespace flexneck::multibody
