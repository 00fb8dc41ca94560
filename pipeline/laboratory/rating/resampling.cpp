// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/resampling.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/rating/curve_pair.h"
#include "pipeline/laboratory/rating/iso18571.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Tolerance for rounded times, relative to the interval between samples.
constexpr double kSameTime = 1e-6 * kIso18571Interval_s;

double first_time(const Curve& curve) { return curve.time_s[0]; }
double last_time(const Curve& curve) { return curve.time_s[curve.time_s.size() - 1]; }

void check_covers(const Curve& curve, double from_s, double to_s) {
  if (first_time(curve) <= from_s + kSameTime && to_s <= last_time(curve) + kSameTime) return;
  throw InputError(
      fmt::format("{}: covers {:.6g} to {:.6g} s, but {:.6g} to {:.6g} s are requested; choose "
                  "another interval",
                  curve.label(), first_time(curve), last_time(curve), from_s, to_s));
}

void check_sampling(const Curve& curve, double from_s, double to_s) {
  for (Index k = 1; k < curve.time_s.size(); ++k) {
    const double begin = curve.time_s[k - 1];
    const double interval = curve.time_s[k] - begin;
    if (curve.time_s[k] <= from_s || begin >= to_s || interval <= kMaxCurveInterval_s * (1 + 1e-6))
      continue;
    throw InputError(
        fmt::format("{}: expected samples at most {:g} s apart, found {:.6g} s after the time "
                    "{:.6g} s; record at shorter intervals",
                    curve.label(), kMaxCurveInterval_s, interval, begin));
  }
}

/// Linear interpolation between samples.
class Interpolation {
 public:
  explicit Interpolation(const Curve& curve) : curve_(curve) {}

  /// Times must not decrease from one call to the next.
  double at(double time_s) {
    const VectorXd& times = curve_.time_s;
    while (next_ + 1 < times.size() && times[next_] < time_s) ++next_;
    const double width = times[next_] - times[next_ - 1];
    const double share = std::clamp((time_s - times[next_ - 1]) / width, 0.0, 1.0);
    if (std::min(share, 1 - share) * width > kSameTime) is_interpolated_ = true;
    return (1 - share) * curve_.values[next_ - 1] + share * curve_.values[next_];
  }
  bool is_interpolated() const { return is_interpolated_; }

 private:
  const Curve& curve_;
  Index next_ = 1;
  bool is_interpolated_ = false;
};

}  // namespace

ResampledPair resampled(const Curve& reference, const Curve& computed, const AskedInterval& asked) {
  const double from_s =
      asked.from_s.value_or(std::max(first_time(reference), first_time(computed)));
  const double to_s = asked.to_s.value_or(std::min(last_time(reference), last_time(computed)));
  if (!(from_s < to_s))
    throw InputError(fmt::format(
        "{} covers {:.6g} to {:.6g} s, {} {:.6g} to {:.6g} s: nothing is left to rate from {:.6g} "
        "to {:.6g} s",
        reference.label(), first_time(reference), last_time(reference), computed.label(),
        first_time(computed), last_time(computed), from_s, to_s));
  for (const Curve* curve : {&reference, &computed}) {
    check_covers(*curve, from_s, to_s);
    check_sampling(*curve, from_s, to_s);
  }
  const double steps = std::floor((to_s - from_s) / kIso18571Interval_s + 1e-6);
  if (steps + 1 < static_cast<double>(kMinRatedSamples) ||
      steps + 1 > static_cast<double>(kMaxRatedSamples))
    throw InputError(
        fmt::format("{}: {:.6g} to {:.6g} s are {:.0f} samples at 10 kHz; expected {} to {}, "
                    "choose another interval",
                    computed.label(), from_s, to_s, steps + 1, kMinRatedSamples, kMaxRatedSamples));
  const auto count = static_cast<Index>(steps) + 1;
  ResampledPair pair{VectorXd(count), VectorXd(count), from_s, kIso18571Interval_s};
  Interpolation of_reference(reference);
  Interpolation of_computed(computed);
  for (Index k = 0; k < count; ++k) {
    const double time_s = from_s + kIso18571Interval_s * static_cast<double>(k);
    pair.reference[k] = of_reference.at(time_s);
    pair.computed[k] = of_computed.at(time_s);
  }
  pair.is_interpolated = of_reference.is_interpolated() || of_computed.is_interpolated();
  return pair;
}

}  // namespace flexneck::pipeline
