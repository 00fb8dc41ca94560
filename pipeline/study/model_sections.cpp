// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "multibody/joints/joint_kinds.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/joint_kind.h"
#include "pipeline/model/rigid_body.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> body_kinds() { return {"ground", "prescribed", "rigid", "deformable"}; }

// Correction modes stand for what many higher modes give statically, so a damping of their own has
// no meaning but to let their ringing die out. On the neck with the head (four normal, six residual
// modes) 0 and 0.05 give the same system damping within 0.3 %, the modes' 0.9 raises it by 4 %; the
// rate 2 zeta omega stays far from the explicit step's limit.
constexpr auto kBodyKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the body"),
        Key::text("kind", kRequired, "What the body is",
                  {.choices = body_kinds, .former_texts = kFormerBodyKinds}),
        Key::texts("modes", kNone, "Of a deformable body: names of its modes"),
        Key::number("damping_ratio", kNone, "Of a deformable body: damping ratio of its modes"),
        Key::number(
            "correction_damping_ratio", "0.05",
            "Damping ratio of modes that only complete the static compliance: it lets their "
            "ringing die out",
            {.origin = Origin::inferred}),
    }),
    kRigidBodyKeys);

constexpr Key kMarkerKeys[] = {
    Key::text("body", kRequired, "Body that carries the marker"),
    Key::text("name", kRequired, "Name of the marker; others call it body.name"),
    Key::quantities("position", "m", kRequired, "Place in the body's frame", {.size = 3}),
};

constexpr std::array kJointKinds = {&multibody::kSphericalJoint, &multibody::kRevoluteJoint,
                                    &multibody::kFixedJoint};

constexpr Key kJointKeys[] = {
    Key::text("name", kRequired, "Name of the joint"),
    Key::text("kind", kRequired, "Which motion it leaves",
              {.choices = [] { return names_of_kinds(kJointKinds); }}),
    Key::text("lower", kRequired, "Marker of the lower body"),
    Key::text("upper", kRequired, "Marker of the upper body"),
    Key::numbers("axis", kNone, "Of a revolute joint: its axis, in both markers' axes",
                 {.size = 3}),
};

constexpr Key kForceKeys[] = {
    Key::text("name", kRequired, "Name of the force"),
    Key::text("marker", kRequired, "Marker that the force acts at"),
    Key::numbers("direction", kRequired, "Direction in the world", {.size = 3}),
    Key::quantities("times", "s", kRequired, "Times of the magnitudes"),
    Key::quantities("magnitudes", "N", kRequired, "Magnitude at each time"),
};

}  // namespace

std::span<const Key> body_keys() { return kBodyKeys; }
std::span<const Key> marker_keys() { return kMarkerKeys; }
std::span<const Key> joint_keys() { return kJointKeys; }
std::span<const Key> force_keys() { return kForceKeys; }

BodySection read_body(const StudyTable& table) {
  BodySection body;
  body.name = table.text("name");
  body.kind = static_cast<BodySection::Kind>(table.choice("kind"));
  switch (body.kind) {
    case BodySection::Kind::ground:
    case BodySection::Kind::prescribed:
      break;
    case BodySection::Kind::rigid:
      body.rigid = read_rigid(table);
      break;
    case BodySection::Kind::deformable:
      body.modes = table.texts("modes");
      body.damping_ratio = table.number("damping_ratio");
      body.correction_damping_ratio = table.number("correction_damping_ratio");
      break;
  }
  table.finish();
  return body;
}

MarkerSection read_marker(const StudyTable& table) {
  MarkerSection marker;
  marker.body = table.text("body");
  marker.name = marker.body + "." + table.text("name");
  marker.position_m = quantity_vector(table, "position");
  table.finish();
  return marker;
}

JointSection read_joint(const StudyTable& table) {
  JointSection joint;
  joint.name = table.text("name");
  joint.kind = joint_kind(table, kJointKinds);
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
  force.times_s = table.quantities("times");
  force.magnitudes_N = table.quantities("magnitudes", force.times_s.size());
  table.finish();
  return force;
}

}  // namespace flexneck::pipeline
