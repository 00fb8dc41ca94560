// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/verdict/pulse_rules.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "pipeline/laboratory/verdict/samples.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

const char* const kTooShort = "the curve does not reach that time";

std::string at_time(const char* what, double time_s) {
  return fmt::format("{} at {:g} ms", what, time_s * 1e3);
}

/// Velocity lost from time zero on; none beyond the samples.
std::optional<double> velocity_lost(const PulseCurve& pulse, double until_s) {
  const std::optional<double> at_start = value_at(pulse.time_s, pulse.deceleration_m_s2, 0);
  const std::optional<double> at_end = value_at(pulse.time_s, pulse.deceleration_m_s2, until_s);
  if (!at_start || !at_end) return {};
  double area = 0;
  std::pair last{0.0, *at_start};
  const auto go_to = [&](double time_s, double deceleration) {
    area += (time_s - last.first) * (deceleration + last.second) / 2;
    last = {time_s, deceleration};
  };
  for (Index k = 0; k < pulse.time_s.size(); ++k)
    if (pulse.time_s[k] > 0 && pulse.time_s[k] < until_s)
      go_to(pulse.time_s[k], pulse.deceleration_m_s2[k]);
  go_to(until_s, *at_end);
  return area;
}

std::optional<double> largest_after(const PulseCurve& pulse, double time_s) {
  std::optional<double> largest;
  for (Index k = 0; k < pulse.time_s.size(); ++k)
    if (pulse.time_s[k] > time_s)
      largest = std::max(largest.value_or(pulse.deceleration_m_s2[k]), pulse.deceleration_m_s2[k]);
  return largest;
}

std::optional<double> decay_time(const PulseCurve& pulse, double level) {
  Index peak = 0;
  if (!(pulse.deceleration_m_s2.maxCoeff(&peak) > level)) return {};
  return first_fall(pulse.time_s, pulse.deceleration_m_s2, level, pulse.time_s[peak]);
}

struct AddPulse {
  const PulseCurve& pulse;
  std::vector<JudgedFigure>& figures;

  void operator()(const DecelerationPulse& rule) const {
    for (std::size_t k = 0; k < rule.times_s.size(); ++k)
      figures.push_back(judged_figure(
          at_time("pulse", rule.times_s[k]), "m/s^2", rule.deceleration_m_s2[k],
          value_at(pulse.time_s, pulse.deceleration_m_s2, rule.times_s[k]), kTooShort));
    figures.push_back(judged_figure(fmt::format("pulse after {:g} ms", rule.times_s.back() * 1e3),
                                    "m/s^2", {.high = rule.highest_after_m_s2},
                                    largest_after(pulse, rule.times_s.back()), kTooShort));
    figures.push_back(judged_figure("time of pulse decay", "s", rule.time_of_decay_s,
                                    decay_time(pulse, rule.decay_to_m_s2), "not within the curve"));
  }

  void operator()(const VelocityPulse& rule) const {
    for (std::size_t k = 0; k < rule.times_s.size(); ++k)
      figures.push_back(judged_figure(at_time("velocity lost", rule.times_s[k]), "m/s",
                                      rule.lost_m_s[k], velocity_lost(pulse, rule.times_s[k]),
                                      kTooShort));
  }
};

}  // namespace

std::vector<JudgedFigure> judged_pulse(const CertificationTest& test, const PulseCurve& pulse) {
  check_samples(pulse.time_s, pulse.deceleration_m_s2);
  std::vector<JudgedFigure> figures;
  std::visit(AddPulse{pulse, figures}, test.pulse);
  return figures;
}

std::vector<JudgedFigure> judged_conditions(const CertificationTest& test,
                                            double impact_velocity_m_s, const PulseCurve& pulse) {
  std::vector<JudgedFigure> figures = judged_pulse(test, pulse);
  figures.insert(figures.begin(), judged_figure("impact velocity", "m/s", test.impact_velocity_m_s,
                                                impact_velocity_m_s, ""));
  return figures;
}

}  // namespace flexneck::pipeline
