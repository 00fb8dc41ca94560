// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/paper_context.h"

#include <algorithm>

#include "multibody/numerics/time_table.h"
#include "pipeline/document/study_document.h"
#include "pipeline/study/origins.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> units() { return {"rad", "N*m", "N", "m/s^2", "m"}; }

constexpr Key kCorridorKeys[] = {
    Key::text("case", kRequired, "Case whose curve it is for"),
    Key::text("channel", kRequired, "That curve"),
    Key::text("what", kRequired, "What of the curve is meant"),
    Key::text("unit", kRequired, "SI unit of the values", {.choices = units}),
    Key::quantities("velocities", "m/s", kRequired, "Impact velocities that it is for, from and to",
                    {.size = 2}),
    Key::quantities("times", "s", kRequired, "Times, from and to", {.size = 2}),
    Key::quantities("values", "rad | N*m | N | m/s^2 | m", kRequired, "Values, from and to",
                    {.size = 2}),
};

constexpr Key kPulseCorridorKeys[] = {
    Key::text("what", kRequired, "What the corridor is called"),
    Key::quantities("times", "s", kRequired, "Times that it is given at"),
    Key::quantities("low", "m/s^2", kRequired, "Least deceleration at each time"),
    Key::quantities("high", "m/s^2", kRequired, "Largest deceleration at each time"),
    Key::quantity("most_after", "m/s^2", kRequired,
                  "Largest deceleration after the last of the times"),
    Key::quantity("decay_level", "m/s^2", kRequired,
                  "Deceleration that the pulse falls below for good"),
    Key::quantities("decay_times", "s", kRequired, "When it does, from and to", {.size = 2}),
};

constexpr Key kKeys[] = {
    Key::text("corridor_source", kRequired, "Where the corridors are from"),
    Key::text("corridor_label", kRequired, "What they are called in a figure"),
    Key::texts("remarks", kRequired, "What the report says of the paper"),
    Key::tables("corridor", "Corridors behind curves", kCorridorKeys),
    Key::tables("pulse_corridor", "Corridors of pulses", kPulseCorridorKeys),
};

Corridor read_corridor(const StudyTable& table) {
  Corridor corridor;
  corridor.experiment = table.text("case");
  corridor.channel = table.text("channel");
  corridor.what = table.text("what");
  corridor.unit = units()[table.choice("unit")];
  const std::vector<double> velocities_m_s = table.quantities("velocities");
  const std::vector<double> times_s = table.quantities("times");
  const std::vector<double> values = table.quantities("values", 0, corridor.unit);
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
  corridor.times_s = table.quantities("times");
  corridor.low_m_s2 = table.quantities("low", corridor.times_s.size());
  corridor.high_m_s2 = table.quantities("high", corridor.times_s.size());
  corridor.most_after_m_s2 = table.quantity("most_after");
  corridor.decay_level_m_s2 = table.quantity("decay_level");
  const std::vector<double> decay_s = table.quantities("decay_times");
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

std::span<const Key> context_keys() { return kKeys; }

PaperContext read_context(const std::filesystem::path& path, const Study& study) {
  const StudyDocument document(path, {}, kKeys);
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
