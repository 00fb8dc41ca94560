// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/formula_force.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/resistance_law.h"

namespace flexneck::pipeline {

using multibody::JointCoordinate;
using multibody::TimeTable;

namespace {

// --------------------------------------------------------------------------- loads over time

std::vector<std::string> outsides() { return {"constant", "zero"}; }

/// Keys of a load's magnitude, constant or as a table.
constexpr auto kMagnitudeKeys =
    joined(std::to_array<Key>({
               Key::quantity("magnitude", "N | N*m", kNone, "Constant magnitude"),
               Key::quantities("times", "s", kNone, "Instead of magnitude: times of a table"),
               Key::quantities("magnitudes", "N | N*m", kNone,
                               "Magnitude at each time; linear in between"),
               Key::text("outside", "constant", "Magnitude before and after the table",
                         {.choices = outsides}),
           }),
           kCsvKeys);

/// Keys of a force and of a torque.
constexpr auto kLoadKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the load"),
        Key::text("marker", kRequired, "Marker at which the load acts"),
        Key::numbers("direction", kRequired,
                     "Direction in the world, or in the marker's axes for a follower load",
                     {.size = 3}),
        Key::flag("follows", "false", "Follower load: its direction rotates with the marker"),
    }),
    kMagnitudeKeys);

constexpr Key kFunctionForceKeys[] = {
    Key::text("name", kRequired, "Name of the force"),
    Key::text("lower", kRequired, "Marker relative to whose moving frame the motion is measured"),
    Key::text("upper", kRequired,
              "Marker at which the load acts; the opposite load acts at the lower marker"),
    Key::text("Fx", kNone,
              "Force in N along the lower marker's x axis: a formula of t in s and of the upper "
              "marker's position x, y, z in m, velocity vx, vy, vz in m/s, rotation vector rx, ry, "
              "rz in rad and angular velocity wx, wy, wz in rad/s"),
    Key::text("Fy", kNone, "Along y"),
    Key::text("Fz", kNone, "Along z"),
    Key::text("Mx", kNone,
              "Moment in N m about the lower marker's x axis at the upper marker: a formula like "
              "that of Fx"),
    Key::text("My", kNone, "About y"),
    Key::text("Mz", kNone, "About z"),
    kBreakpointsKey,
};

constexpr auto kLineForceKeys =
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the force"),
               Key::text("lower", kRequired, "Marker at one end"),
               Key::text("upper", kRequired,
                         "Marker at the other end; a positive force pushes the two apart"),
           }),
           kMagnitudeKeys);

/// Reads a load that is constant, under the key `constant`, or given by a table.
TimeTable load_over_time(const StudyTable& table, const std::string& constant,
                         const ColumnKeys& keys) {
  const TimeTable::Outside outside =
      table.choice("outside") == 1 ? TimeTable::Outside::zero : TimeTable::Outside::constant;
  if (table.has(constant)) {
    table.refuse_given({keys.x, keys.y, "table", "column", "outside"},
                       "the load is already given by '" + constant + "', which is constant");
    return {{0.0}, {table.quantity(constant, keys.y_unit)}, TimeTable::Outside::constant};
  }
  const TableColumns columns = read_columns(table, keys);
  try {
    return {columns.x, columns.y, outside};
  } catch (const InputError& error) {
    table.refuse(table.has("table") ? "table" : keys.x, error.what());
  }
}

// ------------------------------------------------------------------------ springs, resistances

constexpr auto kSpringKeys =
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the spring"),
               Key::text("lower", kRequired, "Marker at one end"),
               Key::text("upper", kRequired, "Marker at the other end"),
               Key::quantity("free_length", "m", kRequired, "Length of the unloaded spring"),
               Key::flag("tension_only", "false", "The spring acts in tension only"),
           }),
           joined(kResistanceKeys, kCsvKeys));

std::vector<std::string> coordinates() { return {"distance", "angle", "flexion"}; }

constexpr auto kJointResistanceKeys =
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the resistance"),
               Key::text("joint", kRequired, "Joint in which the resistance acts"),
               Key::text("coordinate", kRequired,
                         "Motion of the joint that is resisted; flexion is the angle between the "
                         "joint's axes on the two bodies",
                         {.choices = coordinates}),
           }),
           joined(kResistanceKeys, kCsvKeys));

void read_force(const StudyTable& table, Assembly& assembly) {
  multibody::PointForce force;
  force.name = table.text("name");
  force.marker = marker_named(table, "marker", assembly);
  force.direction = unit_vector(table, "direction");
  force.follows = table.flag("follows");
  force.magnitude_N = load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N"});
  assembly.model.forces.add(std::move(force));
  table.finish();
}

void read_torque(const StudyTable& table, Assembly& assembly) {
  multibody::Torque torque;
  torque.name = table.text("name");
  torque.marker = marker_named(table, "marker", assembly);
  torque.direction = unit_vector(table, "direction");
  torque.follows = table.flag("follows");
  torque.magnitude_Nm = load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N*m"});
  assembly.model.forces.add(std::move(torque));
  table.finish();
}

void read_spring(const StudyTable& table, Assembly& assembly) {
  multibody::MarkerSpring spring;
  spring.name = table.text("name");
  spring.marker_i = marker_named(table, "lower", assembly);
  spring.marker_j = marker_named(table, "upper", assembly);
  spring.free_length_m = table.quantity("free_length");
  spring.resistance = read_resistance_law(table, kLinearUnits);
  spring.resistance.tension_only = table.flag("tension_only");
  assembly.model.forces.add(std::move(spring));
  table.finish();
}

void read_resistance(const StudyTable& table, Assembly& assembly) {
  multibody::JointResistance resistance;
  resistance.name = table.text("name");
  resistance.joint = reference(table, "joint", names_of(assembly.model.joints), "joint");
  resistance.coordinate = static_cast<JointCoordinate>(table.choice("coordinate"));
  const bool is_linear = resistance.coordinate == JointCoordinate::distance;
  resistance.resistance = read_resistance_law(table, is_linear ? kLinearUnits : kAngularUnits);
  assembly.model.forces.add(std::move(resistance));
  table.finish();
}

void read_line_force(const StudyTable& table, Assembly& assembly) {
  multibody::LineForce force;
  force.name = table.text("name");
  force.marker_i = marker_named(table, "lower", assembly);
  force.marker_j = marker_named(table, "upper", assembly);
  force.magnitude_N = load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N"});
  assembly.model.forces.add(std::move(force));
  table.finish();
}

constexpr auto kCableKeys = std::to_array<Key>({
    Key::text("name", kRequired, "Name of the cable"),
    Key::text("lower", kRequired, "Marker at one end, in whose axes the direction axis is given"),
    Key::text("upper", kRequired, "Marker at the other end"),
    Key::numbers("axis", kNone, "Direction of the hole in which the cable runs (default: z)",
                 {.size = 3}),
    Key::quantity(
        "length", "m", kNone,
        "Length of the cable's path at the preload (default: that of the initial positions)",
        {.range = kPositive}),
    Key::quantity("preload", "N", "0",
                  "Tension of the cable at that length, included in the unloaded shape of the part",
                  {.range = at_least(0)}),
    Key::quantity("stiffness", "N/m", kRequired, "Tension per elongation", {.range = at_least(0)}),
    Key::quantity("play", "m", "0", "Slack: elongation of the path before the cable is stretched",
                  {.range = at_least(0)}),
});

void read_cable(const StudyTable& table, Assembly& assembly) {
  multibody::Cable cable;
  cable.name = table.text("name");
  cable.marker_i = marker_named(table, "lower", assembly);
  cable.marker_j = marker_named(table, "upper", assembly);
  if (table.has("axis")) cable.axis = unit_vector(table, "axis");
  cable.length_m = table.has("length") ? table.quantity("length") : multibody::Cable::kAsPlaced;
  cable.preload_N = table.quantity("preload");
  cable.stiffness_N_m = table.quantity("stiffness");
  cable.play_m = table.quantity("play");
  assembly.model.forces.add(std::move(cable));
  table.finish();
}

void read_function_force(const StudyTable& table, Assembly& assembly) {
  FormulaForce force{table.text("name"),
                     marker_named(table, "lower", assembly),
                     marker_named(table, "upper", assembly),
                     {},
                     breakpoints(table)};
  bool is_any = false;
  for (std::size_t k = 0; k < force.texts.size(); ++k) {
    force.texts[k] = table.text(StateExpression::kNames[k]);
    if (force.texts[k].empty()) continue;
    is_any = true;
    at_key(table, StateExpression::kNames[k], [&] {
      StateExpression::Texts one;
      one[k] = force.texts[k];
      return StateExpression(one);
    });
  }
  if (!is_any)
    table.refuse("Fx",
                 "expected a formula for at least one of Fx, Fy, Fz, Mx, My and Mz, found none");
  assembly.model.forces.add(function_force_of(force));
  assembly.has_expressions = true;
  table.finish();
}

}  // namespace

std::vector<ModelSection> force_sections() {
  return {
      {Key::tables("force", "Forces at markers", kLoadKeys), read_force},
      {Key::tables("torque", "Torques at markers", kLoadKeys), read_torque},
      {Key::tables("line_force", "Forces along the line between two markers", kLineForceKeys),
       read_line_force},
      {Key::tables("cable", "Cables between two markers, in the hole of a part that bends",
                   kCableKeys),
       read_cable},
      {Key::tables("spring", "Springs and dampers between the origins of two markers", kSpringKeys),
       read_spring},
      bushing_section(),
      elastic_section(),
      {Key::tables("resistance",
                   "Resistances to the motion of joints: stiffness, damping, friction and stops",
                   kJointResistanceKeys),
       read_resistance},
      {Key::tables(
           "function_force",
           "Loads between two markers, given by formulas of time and of their relative motion",
           kFunctionForceKeys),
       read_function_force},
  };
}

}  // namespace flexneck::pipeline
