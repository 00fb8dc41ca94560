// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/verdict/response_rules.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "multibody/signals/response.h"
#include "pipeline/laboratory/verdict/samples.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;
using multibody::Peak;

namespace {

/// The largest positive value, if the signal has its maximum within the record.
std::optional<Peak> upward_peak(const VectorXd& time_s, const VectorXd& signal) {
  Index k = 0;
  const double largest = signal.maxCoeff(&k);
  if (!(largest > 0) || k == 0 || k + 1 == signal.size()) return {};
  return multibody::largest_peak(time_s, signal.cwiseMax(0));
}

const char* no_peak_text(const VectorXd& signal) {
  return signal.maxCoeff() > 0 ? "no peak within the record" : "never in the test's direction";
}

/// The part of the interval between samples k - 1 and k, as fractions, in which a signal is within
/// limits; none if the end precedes the start.
std::pair<double, double> share_inside(const VectorXd& signal, Index k, const Limits& limits) {
  const double start = signal[k - 1];
  const double rise = signal[k] - start;
  if (rise == 0) return limits.contains(start) ? std::pair{0.0, 1.0} : std::pair{1.0, 0.0};
  double from = (limits.low - start) / rise;
  double to = (limits.high - start) / rise;
  if (rise < 0) std::swap(from, to);
  return {std::max(from, 0.0), std::min(to, 1.0)};
}

/// The largest value of a signal while another is within limits.
std::optional<Peak> peak_while_inside(const VectorXd& time_s, const VectorXd& signal,
                                      const VectorXd& other, const Limits& limits) {
  std::optional<Peak> found;
  for (Index k = 1; k < time_s.size(); ++k) {
    const auto [from, to] = share_inside(other, k, limits);
    if (from > to) continue;
    for (const double share : {from, to}) {
      const Peak at{time_s[k - 1] + share * (time_s[k] - time_s[k - 1]),
                    signal[k - 1] + share * (signal[k] - signal[k - 1])};
      if (!found || at.value > found->value) found = at;
    }
    const bool is_turn = k + 1 < time_s.size() && signal[k] >= signal[k - 1] &&
                         signal[k] >= signal[k + 1] && signal[k] > 0;
    if (!is_turn || from > 0 || to < 1 || !limits.contains(other[k + 1])) continue;
    const Peak turn =
        multibody::largest_peak(time_s.segment(k - 1, 3), signal.segment(k - 1, 3).cwiseMax(0));
    if (turn.value > found->value) found = turn;
  }
  return found;
}

void add_rotation(const RotationRule& rule, const VectorXd& time_s, const VectorXd& rotation,
                  std::vector<JudgedFigure>& figures) {
  const std::optional<Peak> peak = upward_peak(time_s, rotation);
  const auto of_peak = [&](double Peak::*member) {
    return peak ? std::optional((*peak).*member) : std::nullopt;
  };
  const std::string problem = no_peak_text(rotation);
  figures.push_back(
      judged_figure("peak rotation", "rad", rule.peak_rad, of_peak(&Peak::value), problem));
  if (rule.time_of_peak_s)
    figures.push_back(judged_figure("time of peak rotation", "s", *rule.time_of_peak_s,
                                    of_peak(&Peak::time_s), problem));
  if (rule.first_zero_crossing_s)
    figures.push_back(
        judged_figure("first zero crossing", "s", *rule.first_zero_crossing_s,
                      peak ? first_fall(time_s, rotation, 0, peak->time_s) : std::nullopt,
                      peak ? "not within the record" : problem));
}

/// Adds the figures of the moment.
/// @param sense  sign of the test's moments, by which the curve is positive
void add_moment(const CertificationTest& test, const ResponseCurves& curves,
                const VectorXd& rotation, const VectorXd& moment, double sense,
                std::vector<JudgedFigure>& figures) {
  const MomentRule& rule = test.moment;
  const VectorXd& time_s = curves.time_s;
  const std::optional<Peak> largest = upward_peak(time_s, moment);
  const std::optional<Peak> peak =
      rule.while_rotation_inside
          ? peak_while_inside(time_s, moment, rotation, test.rotation.peak_rad)
          : largest;
  const std::string problem =
      rule.while_rotation_inside ? "the rotation is never in its corridor" : no_peak_text(moment);
  figures.push_back(judged_figure(
      rule.while_rotation_inside ? "peak moment inside" : "peak moment", "N*m", rule.peak_Nm,
      peak ? std::optional(sense * peak->value) : std::nullopt, problem));
  if (rule.time_of_peak_s)
    figures.push_back(judged_figure("time of peak moment", "s", *rule.time_of_peak_s,
                                    peak ? std::optional(peak->time_s) : std::nullopt, problem));
  const double level = sense * rule.decay_to_Nm;
  const bool decays = largest && largest->value > level;
  figures.push_back(
      judged_figure("time of moment decay", "s", rule.time_of_decay_s,
                    decays ? first_fall(time_s, moment, level, largest->time_s) : std::nullopt,
                    !largest ? no_peak_text(moment)
                    : decays ? "not within the record"
                             : "never above that level"));
}

VectorXd zeroed(const VectorXd& time_s, const VectorXd& signal) {
  return signal.array() - value_at(time_s, signal, 0).value_or(0);
}

}  // namespace

std::vector<JudgedFigure> judged_response(const CertificationTest& test,
                                          const ResponseCurves& curves) {
  check_samples(curves.time_s, curves.rotation_rad);
  check_samples(curves.time_s, curves.moment_Nm);
  const double sense = test.direction == CertificationTest::Direction::extension ? -1 : 1;
  VectorXd rotation = curves.rotation_rad;
  VectorXd moment = curves.moment_Nm;
  if (test.is_zeroed) {
    rotation = zeroed(curves.time_s, rotation);
    moment = zeroed(curves.time_s, moment);
  }
  moment *= sense;
  std::vector<JudgedFigure> figures;
  add_rotation(test.rotation, curves.time_s, rotation, figures);
  add_moment(test, curves, rotation, moment, sense, figures);
  return figures;
}

}  // namespace flexneck::pipeline
