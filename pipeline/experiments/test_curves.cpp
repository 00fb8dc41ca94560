// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/test_curves.h"

#include <cmath>

#include <fmt/core.h>

#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/language/document/channel_class.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Time of free motion before the impact, needed by the filter.
constexpr double kBefore_s = 0.05;
constexpr double kAfter_s = 0.05;
constexpr double kInterval_s = 1e-4;

PulseCurve filtered_pulse(const FittedPulse& pulse, multibody::ChannelClass cfc) {
  const multibody::TimeTable acceleration = pulse.acceleration();
  const auto before = static_cast<Index>(std::lround(kBefore_s / kInterval_s));
  const auto after = static_cast<Index>(std::ceil((pulse.times_s.back() + kAfter_s) / kInterval_s));
  VectorXd deceleration(before + after + 1);
  for (Index k = 0; k < deceleration.size(); ++k)
    deceleration[k] = -acceleration.value(static_cast<double>(k - before) * kInterval_s);
  const VectorXd filtered = cfc_filtered(deceleration, kInterval_s, cfc);
  return {VectorXd::LinSpaced(after + 1, 0, static_cast<double>(after) * kInterval_s),
          filtered.tail(after + 1)};
}

}  // namespace

TestCurves test_curves(const Study& study, const TestSection& test, const CaseSection& experiment,
                       const VectorXd& time_s, const std::vector<multibody::Channel>& channels) {
  const double sense = experiment.direction == CaseSection::Direction::extension ? -1 : 1;
  TestCurves curves;
  curves.response = {time_s, sense * channel_named(channels, "head rotation"),
                     channel_named(channels, "load cell moment")};
  curves.pulse = filtered_pulse(case_pulse(study, experiment), test.rules.pendulum_filter);
  curves.impact_velocity_m_s = experiment.impact_velocity_m_s;
  return curves;
}

std::string moment_difference(const TestSection& test, const CaseSection& experiment) {
  const auto text = [](const MomentDefinition& moment) {
    return fmt::format("M = My - {:.3f} mm Fx with My of {} and Fx of {}", moment.arm_m * 1e3,
                       name_of(moment.moment_filter), name_of(moment.force_filter));
  };
  const std::string has = text(experiment.moment);
  const std::string wanted = text(test.rules.moment_definition);
  return has == wanted ? "" : "the case has " + has + ", the regulation " + wanted;
}

}  // namespace flexneck::pipeline
