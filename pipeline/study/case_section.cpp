// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/names.h"
#include "pipeline/document/table_values.h"
#include "pipeline/study/drop.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

double positive(const StudyTable& table, const std::string& key, const std::string& si_unit) {
  const double value = table.quantity(key, si_unit);
  if (!(value > 0)) table.refuse(key, "expected a positive value");
  return value;
}

void read_velocity(const StudyTable& table, CaseSection& experiment) {
  if (table.has("drop_angle")) {
    experiment.drop_angle_rad = positive(table, "drop_angle", "rad");
    if (*experiment.drop_angle_rad > 3.1416) table.refuse("drop_angle", "expected at most 180 deg");
  }
  if (table.has("effective_length"))
    experiment.effective_length_m = positive(table, "effective_length", "m");
  experiment.velocity_is_given = table.has("impact_velocity");
  if (experiment.velocity_is_given) {
    experiment.impact_velocity_m_s = positive(table, "impact_velocity", "m/s");
  } else if (experiment.drop_angle_rad && experiment.effective_length_m) {
    experiment.impact_velocity_m_s =
        drop_velocity(*experiment.effective_length_m, *experiment.drop_angle_rad);
  } else {
    table.refuse("impact_velocity",
                 "expected this key, or a drop_angle and an effective_length to compute it from");
  }
}

void read_pendulum(const StudyTable& table, CaseSection& experiment) {
  read_velocity(table, experiment);
  experiment.pulse = table.text("pulse");
  if (table.has("pulse_scaling"))
    experiment.pulse_scaling =
        static_cast<PulseFit>(choice(table, "pulse_scaling", {"amplitude", "duration", "none"}));
  if (table.has("arm"))
    experiment.arm =
        static_cast<CaseSection::Arm>(choice(table, "arm", {"translating", "rotating"}));
  for (const auto& [key, value] :
       {std::pair{"pivot_distance", &experiment.pivot_distance_m},
        std::pair{"accelerometer_distance", &experiment.accelerometer_distance_m}}) {
    if (table.has(key) || experiment.arm == CaseSection::Arm::rotating)
      *value = positive(table, key, "m");
  }
  experiment.rigid_neck = table.text_or("rigid_neck", "");
  experiment.head_spring = table.text_or("head_spring", "");
  if (!experiment.rigid_neck.empty() && !experiment.head_spring.empty())
    table.refuse("head_spring", "a rigid neck has a pivot with a spring there already");
}

CaseSection read_case(const StudyTable& table) {
  CaseSection experiment;
  experiment.name = table.text("name");
  experiment.kind = static_cast<CaseSection::Kind>(choice(table, "kind", {"pendulum", "static"}));
  experiment.bodies = table.texts("bodies");
  experiment.direction = static_cast<CaseSection::Direction>(
      choice(table, "direction", {"flexion", "extension", "lateral"}));
  experiment.duration_s = positive(table, "duration", "s");
  if (experiment.kind == CaseSection::Kind::pendulum) {
    read_pendulum(table, experiment);
  } else {
    experiment.forces = table.texts("forces");
  }
  return experiment;
}

/// Whether a name is that of a pattern, whose end may be a *.
bool fits(const std::string& name, const std::string& pattern) {
  if (!pattern.ends_with('*')) return name == pattern;
  return name.starts_with(pattern.substr(0, pattern.size() - 1));
}

/// The cases that a variant makes, in the order of those it is made of.
void add_variants(const StudyTable& variant, const std::vector<StudyTable>& tables,
                  std::vector<CaseSection>& cases) {
  const std::string name = variant.text("name");
  for (const std::string& pattern : variant.texts("of")) {
    bool found = false;
    for (std::size_t k = 0; k < tables.size(); ++k) {
      const std::string of = cases[k].name;
      if (!fits(of, pattern)) continue;
      found = true;
      const StudyTable merged = variant.over(tables[k]);
      CaseSection made = read_case(merged);
      merged.finish();
      made.name = of + "-" + name;
      made.variant_of = of;
      made.variant = name;
      cases.push_back(std::move(made));
    }
    std::vector<std::string> names;
    for (std::size_t k = 0; k < tables.size(); ++k) names.push_back(cases[k].name);
    if (!found)
      variant.refuse("of", "there is no case '" + pattern + "'" + did_you_mean(names, pattern));
  }
}

}  // namespace

std::vector<CaseSection> read_cases(const StudyTable& root) {
  const StudyTable pendulum = root.table("pendulum");
  const StudyTable tester = root.table("static");
  std::vector<StudyTable> tables;
  std::vector<CaseSection> cases;
  for (const StudyTable& own : root.tables("case")) {
    const bool swings = choice(own, "kind", {"pendulum", "static"}) == 0;
    tables.push_back(own.over(swings ? pendulum : tester));
    cases.push_back(read_case(tables.back()));
    tables.back().finish();
  }
  for (const StudyTable& variant : root.tables("variant")) add_variants(variant, tables, cases);
  const auto is_there = [&](CaseSection::Kind kind) {
    for (const CaseSection& experiment : cases)
      if (experiment.kind == kind) return true;
    return false;
  };
  if (is_there(CaseSection::Kind::pendulum)) pendulum.finish();
  if (is_there(CaseSection::Kind::static_test)) tester.finish();
  return cases;
}

}  // namespace flexneck::pipeline
