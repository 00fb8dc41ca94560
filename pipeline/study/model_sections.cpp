// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "geometry/foundation/names.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

std::size_t choice(const StudyTable& table, const std::string& key,
                   const std::vector<std::string>& names) {
  const std::string name = table.text(key);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  std::string expected = "expected one of";
  for (const std::string& each : names) expected += " \"" + each + "\"";
  table.refuse(key, expected + ", found \"" + name + "\"" + did_you_mean(names, name));
}

std::size_t choice_or_first(const StudyTable& table, const std::string& key,
                            const std::vector<std::string>& names) {
  return table.text_or(key, names.front()) == names.front() ? 0 : choice(table, key, names);
}

Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key) {
  const std::vector<double> numbers = table.numbers(key, 3);
  const Eigen::Vector3d vector = Eigen::Map<const Eigen::Vector3d>(numbers.data());
  if (!(vector.norm() > 0)) table.refuse(key, "expected a direction, found a vector of length 0");
  return vector.normalized();
}

Eigen::Vector3d quantity_vector(const StudyTable& table, const std::string& key,
                                const std::string& si_unit) {
  const std::vector<double> values = table.quantities(key, si_unit, 3);
  return Eigen::Map<const Eigen::Vector3d>(values.data());
}

namespace {

/// Inertia about the centre from its six elements xx, yy, zz, xy, xz, yz of the tensor, or from the
/// first three: the products carry the tensor's sign, Ixz = -int x z dm.
Eigen::Matrix3d inertia(const StudyTable& table, const std::string& key) {
  std::vector<double> i = table.quantities(key, "kg*m^2", 0);
  if (i.size() == 3) i.resize(6, 0);
  if (i.size() != 6) {
    table.refuse(key, "expected 3 entries (xx, yy, zz) or 6 (and xy, xz, yz), found " +
                          std::to_string(i.size()));
  }
  Eigen::Matrix3d tensor;
  tensor << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return tensor;
}

}  // namespace

multibody::RigidBody read_rigid(const StudyTable& body) {
  return {body.quantity("mass", "kg"), quantity_vector(body, "center", "m"),
          inertia(body, "inertia")};
}

BodySection read_body(const StudyTable& table) {
  BodySection body;
  body.name = table.text("name");
  body.kind = static_cast<BodySection::Kind>(
      choice(table, "kind", {"ground", "driven", "rigid", "deformable"}));
  switch (body.kind) {
    case BodySection::Kind::ground:
    case BodySection::Kind::driven:
      break;
    case BodySection::Kind::rigid:
      body.rigid = read_rigid(table);
      break;
    case BodySection::Kind::deformable:
      body.modes = table.texts("modes");
      body.damping_ratio = table.number("damping_ratio");
      body.correction_damping_ratio =
          table.number_or("correction_damping_ratio", body.correction_damping_ratio);
      break;
  }
  table.finish();
  return body;
}

MarkerSection read_marker(const StudyTable& table) {
  MarkerSection marker;
  marker.body = table.text("body");
  marker.name = marker.body + "." + table.text("name");
  marker.position_m = quantity_vector(table, "position", "m");
  table.finish();
  return marker;
}

JointSection read_joint(const StudyTable& table) {
  JointSection joint;
  joint.name = table.text("name");
  joint.kind = static_cast<multibody::JointKind>(choice(table, "kind", {"ball", "pin", "fixed"}));
  joint.marker_i = table.text("lower");
  joint.marker_j = table.text("upper");
  if (joint.kind == multibody::JointKind::pin) joint.axis = unit_vector(table, "axis");
  table.finish();
  return joint;
}

ForceSection read_force(const StudyTable& table) {
  ForceSection force;
  force.name = table.text("name");
  force.marker = table.text("marker");
  force.direction = unit_vector(table, "direction");
  force.times_s = table.quantities("times", "s", 0);
  force.magnitudes_N = table.quantities("magnitudes", "N", force.times_s.size());
  table.finish();
  return force;
}

}  // namespace flexneck::pipeline
