// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/foundation/names.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/joint_kind.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

using multibody::Joint;
using multibody::JointAxes;
using multibody::JointKind;

std::vector<std::string> names_of_kinds(std::span<const JointKind* const> kinds) {
  std::vector<std::string> names;
  for (const JointKind* const kind : kinds)
    for (const std::string_view each : {kind->name, kind->alias})
      if (!each.empty()) names.emplace_back(each);
  return names;
}

const JointKind* joint_kind(const StudyTable& table, std::span<const JointKind* const> kinds) {
  const std::string name = table.text("kind");
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const JointKind* kind) {
    return kind->name == name || (!name.empty() && kind->alias == name);
  });
  if (found != kinds.end()) return *found;
  std::string expected = "expected one of";
  for (const JointKind* const kind : kinds) expected += " \"" + std::string(kind->name) + "\"";
  table.refuse("kind",
               expected + ", found \"" + name + "\"" + did_you_mean(names_of_kinds(kinds), name));
}

std::size_t marker_named(const StudyTable& table, const std::string& key,
                         const Assembly& assembly) {
  return reference(table, key, names_of(assembly.model.markers), "marker");
}

namespace {

constexpr auto kJointKeys = std::to_array<Key>({
    Key::text("name", kRequired, "Name of the joint"),
    Key::text("kind", kRequired, "Kind of joint",
              {.choices = [] { return names_of_kinds(multibody::kJointKinds); }}),
    Key::text("lower", kRequired, "Marker of the lower body"),
    Key::text("upper", kRequired,
              "Marker of the upper body, on which the lower one exerts the reaction"),
    Key::numbers("axis", kNone,
                 "Axis of the joint, in the axes of both markers; for a universal joint in those "
                 "of the lower one",
                 {.size = 3}),
    Key::numbers("second_axis", kNone,
                 "Second axis of a universal joint, in the axes of the upper marker", {.size = 3}),
    Key::quantity("length", "m", kNone, "Distance of the markers of a distance joint"),
    Key::quantity("lead", "m", kNone,
                  "Pitch of a screw joint: travel along the axis per revolution"),
    Key::quantity("angle", "rad", "0",
                  "Initial angle, any number of turns; if not given, from the bodies' positions, "
                  "-180 to 180 deg"),
    Key::quantity("rate", "rad/s", "0", "Initial rate of the angle"),
    Key::quantity("distance", "m", "0", "Initial displacement along the axis"),
    Key::quantity("speed", "m/s", "0", "Initial rate of the displacement"),
});

void read_joint(const StudyTable& table, Assembly& assembly) {
  Joint joint;
  joint.name = table.text("name");
  joint.kind = joint_kind(table, multibody::kJointKinds);
  joint.marker_i = marker_named(table, "lower", assembly);
  joint.marker_j = marker_named(table, "upper", assembly);
  if (joint.kind->axes != JointAxes::none) joint.axis = unit_vector(table, "axis");
  if (joint.kind->axes == JointAxes::two) joint.second_axis = unit_vector(table, "second_axis");
  if (const multibody::JointLength& length = joint.kind->length; length.value != nullptr)
    joint.*length.value = table.quantity(std::string(length.key));
  JointStart start;
  const auto read = [&](const char* key, std::optional<double>& value) {
    const double found = table.quantity(key);
    if (table.has(key)) value = found;
  };
  if (joint.kind->has_angle) {
    read("angle", start.angle_rad);
    joint.start_angle_rad = start.angle_rad.value_or(0);
    read("rate", start.rate_rad_s);
  }
  if (joint.kind->has_distance) {
    read("distance", start.distance_m);
    read("speed", start.speed_m_s);
  }
  assembly.model.joints.push_back(std::move(joint));
  assembly.starts.push_back(start);
  table.finish();
}

}  // namespace

ModelSection joint_section() {
  return {Key::tables("joint", "Joints between markers", kJointKeys), read_joint};
}

}  // namespace flexneck::pipeline
