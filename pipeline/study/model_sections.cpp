// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "multibody/joints/joint_kinds.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/joint_kind.h"
#include "pipeline/model/rigid_body.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

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
  constexpr std::array kKinds = {&multibody::kSphericalJoint, &multibody::kRevoluteJoint,
                                 &multibody::kFixedJoint};
  joint.kind = joint_kind(table, kKinds);
  joint.marker_i = table.text("lower");
  joint.marker_j = table.text("upper");
  if (joint.kind == &multibody::kRevoluteJoint) joint.axis = unit_vector(table, "axis");
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
