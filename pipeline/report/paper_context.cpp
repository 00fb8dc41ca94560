// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/paper_context.h"

#include <algorithm>

#include "multibody/numerics/time_table.h"
#include "pipeline/document/study_document.h"
#include "pipeline/study/origins.h"

namespace flexneck::pipeline {

namespace {

Corridor read_corridor(const StudyTable& table) {
  Corridor corridor;
  corridor.experiment = table.text("case");
  corridor.channel = table.text("channel");
  corridor.what = table.text("what");
  corridor.unit = table.text("unit");
  const std::vector<double> velocities_m_s = table.quantities("velocities", "m/s", 2);
  const std::vector<double> times_s = table.quantities("times", "s", 2);
  const std::vector<double> values = table.quantities("values", corridor.unit, 2);
  table.finish();
  corridor.slowest_m_s = velocities_m_s[0];
  corridor.fastest_m_s = velocities_m_s[1];
  corridor.from_s = times_s[0];
  corridor.to_s = times_s[1];
  corridor.low = values[0];
  corridor.high = values[1];
  return corridor;
}

PulseCorridor read_pulse_corridor(const StudyTable& table) {
  PulseCorridor corridor;
  corridor.what = table.text("what");
  corridor.times_s = table.quantities("times", "s", 0);
  corridor.low_m_s2 = table.quantities("low", "m/s^2", corridor.times_s.size());
  corridor.high_m_s2 = table.quantities("high", "m/s^2", corridor.times_s.size());
  corridor.most_after_m_s2 = table.quantity("most_after", "m/s^2");
  corridor.decay_level_m_s2 = table.quantity("decay_level", "m/s^2");
  const std::vector<double> decay_s = table.quantities("decay_times", "s", 2);
  table.finish();
  corridor.decay_from_s = decay_s[0];
  corridor.decay_to_s = decay_s[1];
  return corridor;
}

/// Whether the study's case of that name strikes at a velocity that the corridor is for.
bool applies(const Corridor& corridor, const Study& study) {
  return std::any_of(study.cases.begin(), study.cases.end(), [&](const CaseSection& each) {
    return each.name == corridor.experiment && each.kind == CaseSection::Kind::pendulum &&
           each.impact_velocity_m_s >= corridor.slowest_m_s &&
           each.impact_velocity_m_s <= corridor.fastest_m_s;
  });
}

/// When the pulse falls below a level for good; 0 if it is never above.
double decay_time(const PulseSection& pulse, double level) {
  const std::vector<double>& x = pulse.times_s;
  const std::vector<double>& y = pulse.deceleration_m_s2;
  for (std::size_t k = y.size(); k-- > 0;) {
    if (y[k] < level) continue;
    if (k + 1 == y.size()) return x[k];
    return x[k] + (x[k + 1] - x[k]) * (y[k] - level) / (y[k] - y[k + 1]);
  }
  return 0;
}

}  // namespace

bool is_inside(const PulseSection& pulse, const PulseCorridor& corridor) {
  const multibody::TimeTable table(pulse.times_s, pulse.deceleration_m_s2,
                                   multibody::TimeTable::Outside::zero);
  for (std::size_t k = 0; k < corridor.times_s.size(); ++k) {
    const double value = table.value(corridor.times_s[k]);
    if (value < corridor.low_m_s2[k] || value > corridor.high_m_s2[k]) return false;
  }
  for (std::size_t k = 0; k < pulse.times_s.size(); ++k)
    if (!corridor.times_s.empty() && pulse.times_s[k] > corridor.times_s.back() &&
        pulse.deceleration_m_s2[k] > corridor.most_after_m_s2)
      return false;
  const double decay_s = decay_time(pulse, corridor.decay_level_m_s2);
  return decay_s >= corridor.decay_from_s && decay_s <= corridor.decay_to_s;
}

PaperContext read_context(const std::filesystem::path& path, const Study& study) {
  const StudyDocument document(path, {});
  const StudyTable table = document.root();
  PaperContext context;
  context.corridor_source = table.text("corridor_source");
  context.corridor_label = table.text("corridor_label");
  context.remarks = table.texts("remarks");
  for (const StudyTable& each : table.tables("corridor")) {
    const Corridor corridor = read_corridor(each);
    if (applies(corridor, study)) context.corridors.push_back(corridor);
  }
  for (const StudyTable& each : table.tables("pulse_corridor"))
    context.pulse_corridors.push_back(read_pulse_corridor(each));
  table.finish();
  return context;
}

std::vector<std::string> pulse_remarks(const Study& study, const PaperContext& context) {
  std::vector<std::string> remarks;
  for (const PulseSection* const pulse : pulses_in_use(study)) {
    std::string inside;
    for (const PulseCorridor& corridor : context.pulse_corridors)
      if (is_inside(*pulse, corridor)) inside += (inside.empty() ? "" : " and ") + corridor.what;
    std::string outside;
    for (const PulseCorridor& corridor : context.pulse_corridors)
      outside += (outside.empty() ? "" : " and of ") + corridor.what;
    std::string text = "The pulse '" + pulse->name + "' is " +
                       origins_of(study.parameters, "pulse." + pulse->name) + " by the study";
    if (!inside.empty()) text += " and, as given there, inside " + inside;
    if (inside.empty() && !outside.empty()) text += " and, as given there, outside of " + outside;
    remarks.push_back(text + ". The table of velocities tells how cases scale it.");
  }
  return remarks;
}

}  // namespace flexneck::pipeline
