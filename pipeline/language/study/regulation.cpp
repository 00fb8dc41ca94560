// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/regulation.h"

#include <algorithm>
#include <array>

#include "geometry/foundation/names.h"
#include "pipeline/language/document/channel_class.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> bending_directions() { return {"flexion", "extension"}; }
std::vector<std::string> pulse_kinds() { return {"deceleration", "velocity lost"}; }
std::vector<std::string> moment_units() { return {"N*m", "lbf*ft"}; }
std::vector<std::string> velocity_units() { return {"m/s", "ft/s"}; }

constexpr KeyDetails kPair = {.size = 2};

constexpr Key kRotationKeys[] = {
    Key::quantities("peak", "rad", kRequired,
                    "Limits of the peak rotation of the plane D in the direction of flight", kPair),
    Key::quantities("time_of_peak", "s", kNone, "Limits of the time of the peak", kPair),
    Key::quantities("first_zero_crossing", "s", kNone,
                    "Limits of the time of the first zero crossing in the rebound", kPair),
};

constexpr Key kMomentKeys[] = {
    Key::quantities("peak", "N*m", kRequired,
                    "Limits of the peak moment, with the sign of SAE J211", kPair),
    Key::flag("while_rotation_inside", "false",
              "Evaluate the peak only while the rotation is within its own limits"),
    Key::quantities("time_of_peak", "s", kNone, "Limits of the time of the peak", kPair),
    Key::quantity("decay_to", "N*m", "0", "Moment to which the peak decays"),
    Key::quantities("time_of_decay", "s", kRequired,
                    "Limits of the time at which the moment first reaches decay_to", kPair),
};

constexpr Key kPulseLimitKeys[] = {
    Key::text("kind", kRequired, "Quantity by which the pulse is evaluated",
              {.choices = pulse_kinds}),
    Key::quantities("times", "s", kRequired, "Times at which the limits are given"),
    Key::quantities("low", "m/s^2 | m/s", kRequired, "Lower limit at each time"),
    Key::quantities("high", "m/s^2 | m/s", kRequired, "Upper limit at each time"),
    Key::quantity("highest_after", "m/s^2", kRequired,
                  "Kind deceleration: upper limit after the last of the times"),
    Key::quantity("decay_to", "m/s^2", kRequired,
                  "Kind deceleration: level that the decaying pulse crosses"),
    Key::quantities("time_of_decay", "s", kRequired,
                    "Kind deceleration: limits of the time at which it first crosses that level",
                    kPair),
};

constexpr Key kRegulationKeys[] = {
    Key::text("name", kRequired, "Name of the test, which follows the name of the regulation"),
    Key::text("direction", kRequired, "Direction of bending", {.choices = bending_directions}),
    Key::quantities("impact_velocity", "m/s", kRequired,
                    "Limits of the impact velocity at the accelerometer", kPair),
    Key::table("rotation", "Limits of the rotation of the head's plane D relative to the pendulum",
               kRotationKeys),
    Key::table("moment", "Limits of the moment about the occipital condyles", kMomentKeys),
    Key::table("pulse", "Limits of the pulse of the pendulum", kPulseLimitKeys),
};

constexpr Key kKeys[] = {
    Key::text("regulation", kRequired, "Name of the regulation"),
    Key::text("dummy", kRequired, "Dummy that the regulation applies to"),
    Key::text("source", kRequired, "Source of the limits"),
    Key::flag("zeroed", "false", "Rotation and moment are set to zero at time zero"),
    Key::quantity("moment_arm", "m", kRequired, "Arm of M = My - arm Fx", {.range = at_least(0)}),
    Key::text("force_filter", kRequired, "Channel frequency class of Fx",
              {.choices = channel_class_names}),
    Key::text("moment_filter", kRequired, "Channel frequency class of My",
              {.choices = channel_class_names}),
    Key::text("pendulum_filter", kRequired,
              "Channel frequency class of the pendulum's acceleration",
              {.choices = channel_class_names}),
    Key::text("moment_unit", "N*m", "Unit in which moments are shown", {.choices = moment_units}),
    Key::text("velocity_unit", "m/s", "Unit in which velocities are shown",
              {.choices = velocity_units}),
    Key::tables("test", "Tests of the regulation", kRegulationKeys),
};

Limits read_limits(const StudyTable& table, const char* key) {
  const std::vector<double> pair = table.quantities(key);
  if (!(pair[0] < pair[1])) table.refuse(key, "expected a lower limit, then a higher upper limit");
  return {pair[0], pair[1]};
}

std::optional<Limits> read_limits_if_there(const StudyTable& table, const char* key) {
  if (!table.has(key)) return {};
  return read_limits(table, key);
}

RotationRule read_rotation(const StudyTable& table) {
  RotationRule rule;
  rule.peak_rad = read_limits(table, "peak");
  if (rule.peak_rad.low <= 0) table.refuse("peak", "expected positive angles");
  rule.time_of_peak_s = read_limits_if_there(table, "time_of_peak");
  rule.first_zero_crossing_s = read_limits_if_there(table, "first_zero_crossing");
  table.finish();
  return rule;
}

MomentRule read_moment(const StudyTable& table, CertificationTest::Direction direction) {
  MomentRule rule;
  rule.peak_Nm = read_limits(table, "peak");
  const bool is_extension = direction == CertificationTest::Direction::extension;
  if (is_extension ? rule.peak_Nm.high >= 0 : rule.peak_Nm.low <= 0)
    table.refuse("peak", is_extension ? "expected negative moments in extension"
                                      : "expected positive moments in flexion");
  rule.while_rotation_inside = table.flag("while_rotation_inside");
  rule.time_of_peak_s = read_limits_if_there(table, "time_of_peak");
  rule.decay_to_Nm = table.quantity("decay_to");
  if (is_extension ? rule.decay_to_Nm > 0 || rule.decay_to_Nm <= rule.peak_Nm.high
                   : rule.decay_to_Nm < 0 || rule.decay_to_Nm >= rule.peak_Nm.low)
    table.refuse("decay_to", "expected a moment between zero and the peak");
  rule.time_of_decay_s = read_limits(table, "time_of_decay");
  table.finish();
  return rule;
}

std::vector<Limits> read_corridor(const StudyTable& table, std::size_t size,
                                  const std::string& unit) {
  const std::vector<double> low = table.quantities("low", size, unit);
  const std::vector<double> high = table.quantities("high", size, unit);
  std::vector<Limits> corridor;
  for (std::size_t k = 0; k < size; ++k) {
    if (!(low[k] < high[k]))
      table.refuse("high", "expected values above those of 'low' at each time");
    corridor.push_back({low[k], high[k]});
  }
  return corridor;
}

std::variant<DecelerationPulse, VelocityPulse> read_test_pulse(const StudyTable& table) {
  const bool is_deceleration = table.choice("kind") == 0;
  const std::vector<double> times_s = table.quantities("times");
  const bool increases = std::adjacent_find(times_s.begin(), times_s.end(), [](double a, double b) {
                           return a >= b;
                         }) == times_s.end();
  if (times_s.empty() || !increases || times_s.front() < 0)
    table.refuse("times", "expected at least one time, none below 0, in increasing order");
  if (!is_deceleration) {
    VelocityPulse rule{times_s, read_corridor(table, times_s.size(), "m/s")};
    table.finish();
    return rule;
  }
  DecelerationPulse rule;
  rule.times_s = times_s;
  rule.deceleration_m_s2 = read_corridor(table, times_s.size(), "m/s^2");
  rule.highest_after_m_s2 = table.quantity("highest_after");
  rule.decay_to_m_s2 = table.quantity("decay_to");
  rule.time_of_decay_s = read_limits(table, "time_of_decay");
  table.finish();
  return rule;
}

/// Reads a test.
/// @param common  data shared by all tests of the file
CertificationTest read_test(const StudyTable& table, CertificationTest common) {
  CertificationTest test = std::move(common);
  test.name += " " + table.text("name");
  test.direction = static_cast<CertificationTest::Direction>(table.choice("direction"));
  test.impact_velocity_m_s = read_limits(table, "impact_velocity");
  test.rotation = read_rotation(table.table("rotation"));
  test.moment = read_moment(table.table("moment"), test.direction);
  test.pulse = read_test_pulse(table.table("pulse"));
  table.finish();
  return test;
}

/// The shipped files of regulations, sorted by name.
std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(shipped_file("pipeline/data/regulations")))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::span<const Key> regulation_keys() { return kKeys; }

std::vector<CertificationTest> read_regulation(const fs::path& path) {
  const StudyDocument document(path, {}, kKeys);
  const StudyTable root = document.root();
  CertificationTest common;
  common.name = root.text("regulation");
  common.dummy = root.text("dummy");
  common.source = root.text("source");
  common.is_zeroed = root.flag("zeroed");
  common.moment_definition = {root.quantity("moment_arm"), read_channel_class(root, "force_filter"),
                              read_channel_class(root, "moment_filter")};
  common.pendulum_filter = read_channel_class(root, "pendulum_filter");
  common.moment_unit = moment_units()[root.choice("moment_unit")];
  common.velocity_unit = velocity_units()[root.choice("velocity_unit")];
  std::vector<CertificationTest> tests;
  for (const StudyTable& table : root.tables("test")) tests.push_back(read_test(table, common));
  root.finish();
  at_key(root, "test", [&] { check_names(names_of(tests), "test"); });
  return tests;
}

ShippedTest shipped_test(const std::string& name) {
  std::vector<ShippedTest> all;
  std::vector<std::string> names;
  for (const fs::path& file : shipped_files()) {
    for (CertificationTest& test : read_regulation(file)) {
      names.push_back(test.name);
      all.push_back({std::move(test), file});
    }
  }
  return all[find_name(names, name, "test of a regulation")];
}

}  // namespace flexneck::pipeline
