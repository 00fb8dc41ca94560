// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/time_table.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

constexpr auto kPulseKeys =
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the pulse"),
               Key::quantities("times", "s", kNone, "Times from the impact of the arm"),
               Key::quantities("deceleration", "m/s^2", kNone,
                               "Deceleration at each time; linear in between, zero outside"),
           }),
           kCsvKeys);

}  // namespace

std::span<const Key> pulse_keys() { return kPulseKeys; }

PulseSection read_pulse(const StudyTable& table) {
  PulseSection pulse;
  pulse.name = table.text("name");
  TableColumns columns = read_columns(table, {"times", "s", "deceleration", "m/s^2"});
  const char* const key = table.has("table") ? "table" : "times";
  // The table itself checks the times.
  at_key(table, key, [&] {
    return multibody::TimeTable(columns.x, columns.y, multibody::TimeTable::Outside::zero);
  });
  if (columns.x.size() < 2 || columns.x.front() < 0)
    table.refuse(key, "expected at least two times, none before 0, the time of the impact");
  pulse.times_s = std::move(columns.x);
  pulse.deceleration_m_s2 = std::move(columns.y);
  table.finish();
  return pulse;
}

}  // namespace flexneck::pipeline
