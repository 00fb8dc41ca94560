// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "multibody/numerics/time_table.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/model_sections.h"
#include "pipeline/model/resistance_law.h"
#include "pipeline/model/rigid_body.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

constexpr auto kPulseKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the pulse"),
        Key::quantities("times", "s", kNone, "Times of the decelerations, from the arm's impact"),
        Key::quantities("deceleration", "m/s^2", kNone,
                        "Deceleration at each time; linear between them, zero outside"),
    }),
    kCsvKeys);

constexpr auto kPivotSideKeys = joined(kResistanceSideKeys, kCsvKeys);

constexpr Key kPivotKeys[] = {
    Key::quantity("height", "m", kRequired,
                  "Height of the pivot above the base, on the neck's axis"),
    Key::quantity("damping", "N*m*s/rad", "0", "Viscous damping"),
    Key::table("flexion", "Resistance to bending forward", kPivotSideKeys),
    Key::table("extension", "Resistance to bending backward", kPivotSideKeys),
    Key::table("lateral", "Resistance to bending sideways", kPivotSideKeys),
};

constexpr auto kRigidNeckKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the rigid neck"),
        Key::flag(
            "equivalent", "false",
            "Made to have mass, static stiffness and damping of the deformable neck, in place "
            "of all that follows",
            {.formerly = "matches_neck"}),
        Key::table("lower", "Pivot below", kPivotKeys),
        Key::table("upper", "Pivot above", kPivotKeys),
    }),
    kRigidBodyKeys);

constexpr auto kHeadSpringKeys =
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the spring"),
               Key::numbers("axis", kNone, "Axis that the head nods about; y if it is not there",
                            {.size = 3}),
           }),
           joined(kResistanceKeys, kCsvKeys));

}  // namespace

std::span<const Key> pulse_keys() { return kPulseKeys; }
std::span<const Key> rigid_neck_keys() { return kRigidNeckKeys; }
std::span<const Key> head_spring_keys() { return kHeadSpringKeys; }

PulseSection read_pulse(const StudyTable& table, std::vector<InputFile>& files) {
  PulseSection pulse;
  pulse.name = table.text("name");
  TableColumns columns = read_columns(table, {"times", "s", "deceleration", "m/s^2"}, files);
  const char* const key = table.has("table") ? "table" : "times";
  // The table itself knows what times must be.
  at_key(table, key, [&] {
    return multibody::TimeTable(columns.x, columns.y, multibody::TimeTable::Outside::zero);
  });
  if (columns.x.size() < 2 || columns.x.front() < 0)
    table.refuse(key, "expected two times or more, none before 0, when the arm is struck");
  pulse.times_s = std::move(columns.x);
  pulse.deceleration_m_s2 = std::move(columns.y);
  table.finish();
  return pulse;
}

namespace {

RigidNeckSection::Pivot read_pivot(const StudyTable& table, std::vector<InputFile>& files) {
  RigidNeckSection::Pivot pivot;
  pivot.height_m = table.quantity("height");
  pivot.fore_aft.damping = pivot.lateral.damping = table.quantity("damping");
  const auto side = [&](const char* key) {
    const StudyTable own = table.table(key);
    multibody::ResistanceSide read = read_resistance_side(own, kAngularUnits, files);
    own.finish();
    return read;
  };
  pivot.fore_aft.positive = side("flexion");
  pivot.fore_aft.negative = side("extension");
  pivot.lateral.positive = pivot.lateral.negative = side("lateral");
  table.finish();
  return pivot;
}

}  // namespace

RigidNeckSection read_rigid_neck(const StudyTable& table, std::vector<InputFile>& files) {
  RigidNeckSection neck;
  neck.name = table.text("name");
  neck.is_equivalent = table.flag("equivalent");
  if (!neck.is_equivalent) {
    neck.rigid = read_rigid(table);
    neck.lower = read_pivot(table.table("lower"), files);
    neck.upper = read_pivot(table.table("upper"), files);
    if (!(neck.upper.height_m > neck.lower.height_m))
      table.refuse("upper", "expected this pivot above the lower one");
  }
  table.finish();
  return neck;
}

HeadSpringSection read_head_spring(const StudyTable& table, std::vector<InputFile>& files) {
  HeadSpringSection spring;
  spring.name = table.text("name");
  if (table.has("axis")) spring.axis = unit_vector(table, "axis");
  spring.resistance = read_resistance_law(table, kAngularUnits, files);
  table.finish();
  return spring;
}

}  // namespace flexneck::pipeline
