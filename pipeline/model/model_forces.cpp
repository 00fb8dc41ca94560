// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/model_sections.h"
#include "pipeline/model/resistance_law.h"

namespace flexneck::pipeline {

using multibody::JointCoordinate;
using multibody::TimeTable;

namespace {

// --------------------------------------------------------------------------- loads over time

/// A load that is the same at all times under the key `constant`, or a table.
TimeTable load_over_time(const StudyTable& table, const std::string& constant,
                         const ColumnKeys& keys, Assembly& assembly) {
  const TimeTable::Outside outside =
      table.has("outside") && choice(table, "outside", {"constant", "zero"}) == 1
          ? TimeTable::Outside::zero
          : TimeTable::Outside::constant;
  if (table.has(constant)) {
    for (const std::string& key : {keys.x, std::string("table")})
      if (table.has(key)) table.refuse(key, "the load is given already by '" + constant + "'");
    return {{0.0}, {table.quantity(constant, keys.y_unit)}, TimeTable::Outside::constant};
  }
  const TableColumns columns = read_columns(table, keys, assembly.files);
  try {
    return {columns.x, columns.y, outside};
  } catch (const InputError& error) {
    table.refuse(table.has("table") ? "table" : keys.x, error.what());
  }
}

// -------------------------------------------------------------------------------- bushings

/// Nine numbers row by row, or three on the diagonal.
Eigen::Matrix3d block(const StudyTable& table, const std::string& key, const std::string& unit) {
  if (!table.has(key)) return Eigen::Matrix3d::Zero();
  const std::vector<double> values = table.quantities(key, unit, 0);
  if (values.size() == 3)
    return Eigen::Map<const Eigen::Vector3d>(values.data()).asDiagonal().toDenseMatrix();
  if (values.size() != 9)
    table.refuse(key, "expected 3 entries (a diagonal) or 9 (a matrix row by row), found " +
                          std::to_string(values.size()));
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
}

/// @param rate  "" for a stiffness, "*s" for a damping
Eigen::Matrix<double, 6, 6> bushing_matrix(const StudyTable& table, const std::string& what,
                                           const std::string& rate) {
  Eigen::Matrix<double, 6, 6> matrix;
  const Eigen::Matrix3d coupling = block(table, "coupling_" + what, "N" + rate + "/rad");
  matrix << block(table, "translation_" + what, "N" + rate + "/m"), coupling, coupling.transpose(),
      block(table, "rotation_" + what, "N*m" + rate + "/rad");
  return matrix;
}

}  // namespace

void read_force(const StudyTable& table, Assembly& assembly) {
  multibody::PointForce force;
  force.name = table.text("name");
  force.marker = marker_named(table, "marker", assembly);
  force.direction = unit_vector(table, "direction");
  force.magnitude_N =
      load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N"}, assembly);
  assembly.model.forces.add(std::move(force));
  table.finish();
}

void read_torque(const StudyTable& table, Assembly& assembly) {
  multibody::Torque torque;
  torque.name = table.text("name");
  torque.marker = marker_named(table, "marker", assembly);
  torque.direction = unit_vector(table, "direction");
  torque.magnitude_Nm =
      load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N*m"}, assembly);
  assembly.model.forces.add(std::move(torque));
  table.finish();
}

void read_spring(const StudyTable& table, Assembly& assembly) {
  multibody::MarkerSpring spring;
  spring.name = table.text("name");
  spring.marker_i = marker_named(table, "lower", assembly);
  spring.marker_j = marker_named(table, "upper", assembly);
  spring.free_length_m = table.quantity("free_length", "m");
  spring.resistance = read_resistance_law(table, kLinearUnits, assembly.files);
  spring.resistance.tension_only = table.flag_or("tension_only", false);
  assembly.model.forces.add(std::move(spring));
  table.finish();
}

void read_bushing(const StudyTable& table, Assembly& assembly) {
  multibody::Bushing bushing;
  bushing.name = table.text("name");
  bushing.marker_i = marker_named(table, "lower", assembly);
  bushing.marker_j = marker_named(table, "upper", assembly);
  bushing.stiffness = bushing_matrix(table, "stiffness", "");
  bushing.damping = bushing_matrix(table, "damping", "*s");
  assembly.model.forces.add(std::move(bushing));
  table.finish();
}

void read_resistance(const StudyTable& table, Assembly& assembly) {
  multibody::JointResistance resistance;
  resistance.name = table.text("name");
  resistance.joint = reference(table, "joint", names_of(assembly.model.joints), "joint");
  resistance.coordinate =
      static_cast<JointCoordinate>(choice(table, "coordinate", {"distance", "angle", "flexion"}));
  const bool is_linear = resistance.coordinate == JointCoordinate::distance;
  resistance.resistance =
      read_resistance_law(table, is_linear ? kLinearUnits : kAngularUnits, assembly.files);
  assembly.model.forces.add(std::move(resistance));
  table.finish();
}

void read_line_force(const StudyTable& table, Assembly& assembly) {
  multibody::LineForce force;
  force.name = table.text("name");
  force.marker_i = marker_named(table, "lower", assembly);
  force.marker_j = marker_named(table, "upper", assembly);
  force.magnitude_N =
      load_over_time(table, "magnitude", {"times", "s", "magnitudes", "N"}, assembly);
  assembly.model.forces.add(std::move(force));
  table.finish();
}

}  // namespace flexneck::pipeline
