// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of a prescribed body, along a direction and about an axis, and of a motor in a joint.
#include <array>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/expression.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/pulse.h"

namespace flexneck::pipeline {

using multibody::JointMotor;
using multibody::PrescribedBody;
using multibody::SmoothMotion;
using multibody::TimeTable;

namespace {

/// Names and units of the keys of one coordinate. Its acceleration has the same name for both.
struct MotionKeys {
  std::string value, value_table, value_unit;
  std::string rate;
  std::string acceleration_unit;
};
const MotionKeys kTravel = {"displacement", "displacement_table", "m", "initial_velocity", "m/s^2"};
const MotionKeys kDistance = {"distance", "distance_table", "m", "initial_speed", "m/s^2"};
const MotionKeys kAngle = {"angle", "angle_table", "rad", "initial_rate", "rad/s^2"};

/// Keys of a motion besides those of the coordinate and kCsvKeys.
constexpr auto kMotionKeys = std::to_array<Key>({
    Key::quantities("times", "s", kNone, "Times of a motion that is given by lists"),
    Key::expression_or_quantities("acceleration", "m/s^2 | rad/s^2", kNone,
                                  "Acceleration at each time, or an expression of the time t"),
    Key::quantities("pulse_times", "s", kNone,
                    "Times of a deceleration pulse that is scaled so that it stops the motion"),
    Key::quantities("pulse_deceleration", "m/s^2 | rad/s^2", kNone,
                    "Deceleration at each of these times; only its shape matters"),
    kBreakpointsKey,
});

constexpr auto kAngleKeys = std::to_array<Key>({
    Key::expression_or_quantities("angle", "rad", kNone,
                                  "Angle at each time, or an expression of the time t"),
    Key::file("angle_table", kNone, "CSV file with the angle over time"),
    Key::quantity("initial_rate", "rad/s", "0",
                  "Initial rate of rotation, to which the motion is added"),
});

constexpr auto kTurnKeys = joined(
    std::to_array<Key>({
        Key::numbers("axis", kRequired, "Axis of rotation, in the world", {.size = 3}),
        Key::quantities("point", "m", kNone,
                        "Point on the axis (default: the position of the body)", {.size = 3}),
    }),
    joined(kAngleKeys, joined(kMotionKeys, kCsvKeys)));

constexpr auto kPrescribedKeys = joined(
    std::to_array<Key>({
        Key::numbers("direction", kNone,
                     "Direction of travel of a prescribed body, in the world (default: x)",
                     {.size = 3}),
        Key::expression_or_quantities("displacement", "m", kNone,
                                      "Displacement at each time, or an expression of the time t"),
        Key::file("displacement_table", kNone, "CSV file with the displacement over time"),
        Key::quantity("initial_velocity", "m/s", "0",
                      "Initial velocity along the direction, to which the motion is added"),
        Key::table("turn", "Rotation of a prescribed body", kTurnKeys),
    }),
    joined(kMotionKeys, kCsvKeys));

std::vector<std::string> motor_coordinates() { return {"angle", "distance"}; }

constexpr auto kMotorKeys = joined(
    joined(std::to_array<Key>({
               Key::text("name", kRequired, "Name of the motor"),
               Key::text("joint", kRequired, "Joint that the motor moves"),
               Key::text("coordinate", kRequired, "Motion of the joint that the motor prescribes",
                         {.choices = motor_coordinates}),
               Key::expression_or_quantities(
                   "distance", "m", kNone, "Distance at each time, or an expression of the time t"),
               Key::file("distance_table", kNone, "CSV file with the distance over time"),
               Key::quantity("initial_speed", "m/s", "0",
                             "Initial rate of the distance, to which the motion is added"),
           }),
           kAngleKeys),
    joined(kMotionKeys, kCsvKeys));

struct Motion {
  double initial_rate = 0;
  TimeTable acceleration;
  SmoothMotion function;
};

/// The key that gives the motion, of which only one may be present; empty if there is none.
std::string motion_key(const StudyTable& table, const MotionKeys& keys) {
  const std::array<std::string, 5> all = {"table", "acceleration", "pulse_times", keys.value,
                                          keys.value_table};
  std::string found;
  for (const std::string& key : all) {
    if (!table.has(key)) continue;
    if (!found.empty())
      table.refuse(key, "the motion is already given by '" + found + "'; remove one of them");
    found = key;
  }
  return found;
}

TimeTable acceleration_table(const StudyTable& table, const MotionKeys& keys) {
  const TableColumns columns =
      read_columns(table, {"times", "s", "acceleration", keys.acceleration_unit});
  return at_key(table, table.has("table") ? "table" : "times",
                [&] { return TimeTable(columns.x, columns.y, TimeTable::Outside::zero); });
}

TimeTable pulse(const StudyTable& table, const MotionKeys& keys, double rate) {
  const std::vector<double> times = table.quantities("pulse_times");
  const std::vector<double> values =
      table.quantities("pulse_deceleration", times.size(), keys.acceleration_unit);
  return at_key(table, "pulse_deceleration", [&] { return braking_pulse(times, values, rate); });
}

SmoothMotion expressed_motion(const StudyTable& table, const std::string& key, Assembly& assembly) {
  assembly.has_expressions = true;
  const multibody::Sampling sampling{assembly.resolution_s, breakpoints(table)};
  return at_key(table, key, [&] {
    const Expression expression(table.text(key));
    return key == "acceleration"
               ? SmoothMotion::of_acceleration(expression, assembly.end_time_s, sampling)
               : SmoothMotion::of_displacement(expression, assembly.end_time_s, sampling);
  });
}

SmoothMotion tabulated_motion(const StudyTable& table, const MotionKeys& keys,
                              const std::string& key, Assembly& assembly) {
  const TableColumns columns =
      read_columns(table, {"times", "s", keys.value, keys.value_unit, keys.value_table});
  return at_key(table, key, [&] {
    SmoothMotion motion = SmoothMotion::of_displacement_table(columns.x, columns.y);
    if (columns.x.front() > 0 || columns.x.back() < assembly.end_time_s) {
      throw InputError("the times must cover the run, from 0 to " +
                       rounded_text(assembly.end_time_s) + " s, but are from " +
                       rounded_text(columns.x.front()) + " to " + rounded_text(columns.x.back()) +
                       " s");
    }
    return motion;
  });
}

Motion read_motion(const StudyTable& table, const MotionKeys& keys, Assembly& assembly) {
  Motion motion;
  motion.initial_rate = table.quantity(keys.rate);
  const std::string key = motion_key(table, keys);
  const bool is_expression =
      !key.empty() && table.is_text(key) && (key == keys.value || key == "acceleration");
  if (!is_expression && table.has("breakpoints"))
    table.refuse("breakpoints",
                 "has no effect without a motion that is given by an expression of t");
  if (key != "table" && key != keys.value_table)
    table.refuse_given({"column"}, "has no effect without a CSV file whose column it selects");
  if (key.empty()) return motion;
  if (key == "pulse_times") {
    motion.acceleration = pulse(table, keys, motion.initial_rate);
  } else if (is_expression) {
    motion.function = expressed_motion(table, key, assembly);
  } else if (key == keys.value || key == keys.value_table) {
    motion.function = tabulated_motion(table, keys, key, assembly);
  } else {
    motion.acceleration = acceleration_table(table, keys);
  }
  return motion;
}

multibody::PrescribedTurn read_turn(const StudyTable& table, const Eigen::Vector3d& position_m,
                                    Assembly& assembly) {
  multibody::PrescribedTurn turn;
  turn.axis = unit_vector(table, "axis");
  turn.point_m = table.has("point") ? quantity_vector(table, "point") : position_m;
  const Motion motion = read_motion(table, kAngle, assembly);
  turn.initial_rate_rad_s = motion.initial_rate;
  turn.acceleration_rad_s2 = motion.acceleration;
  turn.motion = motion.function;
  if (motion_key(table, kAngle).empty() && !table.has(kAngle.rate))
    table.refuse("axis",
                 "expected the motion of the rotation: angle, angle_table, times and acceleration, "
                 "table, pulse_times or initial_rate");
  table.finish();
  return turn;
}

/// Sets the initial value and rate of a joint from its motor. @param table  the motor's table, for
/// messages
/// @param value  initial value
/// @param rate  initial rate; given if the joint's own table has it
void start_at(const JointMotor& motor, const StudyTable& table, std::optional<double>& value,
              std::optional<double>& rate) {
  if (rate)
    table.refuse("joint",
                 "the initial rate is given by the joint and by this motor; remove one of them");
  value = motor.start + motor.path.value(0);
  rate = motor.path.rate(0);
}

void read_motor(const StudyTable& table, Assembly& assembly) {
  JointMotor motor;
  motor.name = table.text("name");
  const std::size_t index = reference(table, "joint", names_of(assembly.model.joints), "joint");
  const bool turns = table.choice("coordinate") == 0;
  const MotionKeys& keys = turns ? kAngle : kDistance;
  const Motion motion = read_motion(table, keys, assembly);
  if (motion_key(table, keys).empty() && !table.has(keys.rate))
    table.refuse("name", "expected the motion of the motor: " + keys.value + ", " +
                             keys.value_table + ", times and acceleration, table, pulse_times or " +
                             keys.rate);
  motor.coordinate =
      turns ? multibody::JointCoordinate::angle : multibody::JointCoordinate::distance;
  motor.path = {motion.initial_rate, motion.acceleration, motion.function};
  JointStart& start = assembly.starts[index];
  motor.start = (turns ? start.angle_rad : start.distance_m).value_or(0);
  if (turns)
    start_at(motor, table, start.angle_rad, start.rate_rad_s);
  else
    start_at(motor, table, start.distance_m, start.speed_m_s);
  assembly.model.joints[index].motors.push_back(std::move(motor));
  table.finish();
}

}  // namespace

ModelSection motor_section() {
  return {Key::tables("motor", "Motors: prescribed motions of joints", kMotorKeys), read_motor};
}

std::span<const Key> prescribed_body_keys() { return kPrescribedKeys; }

namespace {

bool gives_motion(const StudyTable& table) {
  return table.has("turn") || table.has(kTravel.rate) || !motion_key(table, kTravel).empty();
}

void refuse_motion(const StudyTable& table) {
  for (const Key& row : prescribed_body_keys())
    if (table.has(std::string(row.name)))
      table.refuse(
          std::string(row.name),
          "has no effect, since the case determines the motion of this body; remove this key");
}

}  // namespace

PrescribedBody prescribed_body(const StudyTable& table, Assembly& assembly) {
  PrescribedBody body;
  if (assembly.motion == Assembly::Motion::by_case) refuse_motion(table);
  if (assembly.motion != Assembly::Motion::given && !gives_motion(table)) return body;
  if (table.has("direction")) body.direction = unit_vector(table, "direction");
  if (motion_key(table, kTravel).empty() && !table.has(kTravel.rate))
    table.refuse_given({"direction"}, "has no effect on a body that only rotates");
  const Motion motion = read_motion(table, kTravel, assembly);
  body.initial_velocity_m_s = motion.initial_rate;
  body.acceleration_m_s2 = motion.acceleration;
  body.motion = motion.function;
  if (table.has("turn")) {
    const Eigen::Vector3d position_m =
        table.has("position") ? quantity_vector(table, "position") : Eigen::Vector3d::Zero();
    body.turn = read_turn(table.table("turn"), position_m, assembly);
  } else if (!gives_motion(table)) {
    table.refuse("name",
                 "expected the motion of a prescribed body: times and acceleration, table, "
                 "pulse_times, displacement, displacement_table, initial_velocity or [body.turn]; "
                 "a body without motion has kind = \"ground\"");
  }
  return body;
}

}  // namespace flexneck::pipeline
