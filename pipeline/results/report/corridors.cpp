// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/corridors.h"

#include <algorithm>
#include <map>

#include "geometry/foundation/names.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/laboratory/verdict/pulse_rules.h"
#include "pipeline/language/study/origins.h"

namespace flexneck::pipeline {

namespace {

/// Limits with the sign of the channel: rules measure angles in the direction of flight, channels
/// are negative in extension.
Limits in_channel(const Limits& limits, CertificationTest::Direction direction) {
  if (direction == CertificationTest::Direction::flexion) return limits;
  return {-limits.high, -limits.low};
}

void add_corridors(const TestSection& test, std::vector<Corridor>& corridors) {
  const CertificationTest& rules = test.rules;
  const auto add = [&](const char* channel, const char* what, const char* unit,
                       const std::optional<Limits>& times_s, const Limits& values) {
    if (times_s)
      corridors.push_back({test.experiment, channel, rules.name + ", " + what, unit, *times_s,
                           values, rules.source});
  };
  const RotationRule& rotation = rules.rotation;
  add("head rotation", "peak rotation", "rad", rotation.time_of_peak_s,
      in_channel(rotation.peak_rad, rules.direction));
  add("head rotation", "first zero crossing", "rad", rotation.first_zero_crossing_s, {0, 0});
  const MomentRule& moment = rules.moment;
  for (const char* const channel : {"occipital moment", "load cell moment"}) {
    add(channel, "peak moment", "N*m", moment.time_of_peak_s, moment.peak_Nm);
    add(channel, "moment decay", "N*m", moment.time_of_decay_s,
        {moment.decay_to_Nm, moment.decay_to_Nm});
  }
}

/// Tests by pulse, each once, since several cases may be judged by the same test.
std::map<std::string, const CertificationTest*> tests_of_pulses(const Study& study) {
  std::map<std::string, const CertificationTest*> tests;
  for (const TestSection& test : study.tests)
    if (applies(test, study) && std::holds_alternative<DecelerationPulse>(test.rules.pulse))
      tests.emplace(test.rules.name, &test.rules);
  return tests;
}

}  // namespace

std::vector<Corridor> corridors_of(const Study& study) {
  std::vector<Corridor> corridors;
  for (const TestSection& test : study.tests) {
    const CaseSection& experiment =
        study.cases[find_name(names_of(study.cases), test.experiment, "case")];
    if (applies(test, study) &&
        test.rules.impact_velocity_m_s.contains(experiment.impact_velocity_m_s))
      add_corridors(test, corridors);
  }
  return corridors;
}

bool is_inside(const PulseSection& pulse, const CertificationTest& test) {
  const auto count = static_cast<Eigen::Index>(pulse.times_s.size());
  const std::vector<JudgedFigure> figures =
      judged_pulse(test, {Eigen::VectorXd::Map(pulse.times_s.data(), count),
                          Eigen::VectorXd::Map(pulse.deceleration_m_s2.data(), count)});
  return std::all_of(figures.begin(), figures.end(),
                     [](const JudgedFigure& figure) { return figure.is_inside(); });
}

std::vector<std::string> pulse_remarks(const Study& study) {
  const auto tests = tests_of_pulses(study);
  std::vector<std::string> remarks;
  for (const PulseSection* const pulse : pulses_in_use(study)) {
    std::string inside;
    std::string outside;
    for (const auto& [name, test] : tests) {
      if (is_inside(*pulse, *test)) inside += (inside.empty() ? "" : " and ") + name;
      outside += (outside.empty() ? "" : " and of ") + name;
    }
    std::string text = "The pulse '" + pulse->name + "' is " +
                       origins_of(study.parameters, "pulse." + pulse->name) +
                       " according to the study";
    if (!inside.empty()) text += " and, without scaling, inside the corridor of " + inside;
    if (inside.empty() && !outside.empty())
      text += " and, without scaling, outside the corridor of " + outside;
    remarks.push_back(text + ". The table of velocities shows how the cases scale it.");
  }
  return remarks;
}

}  // namespace flexneck::pipeline
