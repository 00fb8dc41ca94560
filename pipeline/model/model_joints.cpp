// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/foundation/names.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/joint_kind.h"
#include "pipeline/model/model_sections.h"

namespace flexneck::pipeline {

using multibody::Joint;
using multibody::JointAxes;
using multibody::JointKind;

const JointKind* joint_kind(const StudyTable& table, std::span<const JointKind* const> kinds) {
  const std::string name = table.text("kind");
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const JointKind* kind) {
    return kind->name == name || (!name.empty() && kind->alias == name);
  });
  if (found != kinds.end()) return *found;
  std::vector<std::string> names;
  std::string expected = "expected one of";
  for (const JointKind* const kind : kinds) {
    expected += " \"" + std::string(kind->name) + "\"";
    for (const std::string_view each : {kind->name, kind->alias})
      if (!each.empty()) names.emplace_back(each);
  }
  table.refuse("kind", expected + ", found \"" + name + "\"" + did_you_mean(names, name));
}

std::size_t marker_named(const StudyTable& table, const std::string& key,
                         const Assembly& assembly) {
  return reference(table, key, names_of(assembly.model.markers), "marker");
}

void read_joint(const StudyTable& table, Assembly& assembly) {
  Joint joint;
  joint.name = table.text("name");
  joint.kind = joint_kind(table, multibody::kJointKinds);
  joint.marker_i = marker_named(table, "lower", assembly);
  joint.marker_j = marker_named(table, "upper", assembly);
  if (joint.kind->axes != JointAxes::none) joint.axis = unit_vector(table, "axis");
  if (joint.kind->axes == JointAxes::two) joint.second_axis = unit_vector(table, "second_axis");
  if (const multibody::JointLength& length = joint.kind->length; length.value != nullptr)
    joint.*length.value = table.quantity(std::string(length.key), "m");
  JointStart start;
  const auto read = [&](const char* key, const char* unit, std::optional<double>& value) {
    const double found = table.quantity_or(key, unit, 0);
    if (table.has(key)) value = found;
  };
  if (joint.kind->has_angle) {
    read("angle", "rad", start.angle_rad);
    read("rate", "rad/s", start.rate_rad_s);
  }
  if (joint.kind->has_distance) {
    read("distance", "m", start.distance_m);
    read("speed", "m/s", start.speed_m_s);
  }
  assembly.model.joints.push_back(std::move(joint));
  assembly.starts.push_back(start);
  table.finish();
}

}  // namespace flexneck::pipeline
