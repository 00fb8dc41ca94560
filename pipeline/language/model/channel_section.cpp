// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/channel_section.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/channel_class.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/placement.h"

namespace flexneck::pipeline {

using multibody::ChannelClass;
using multibody::Model;

namespace {

/// Names in the order of Quantity.
std::vector<std::string> quantities() {
  return {"position", "velocity",         "acceleration",         "rotation_vector", "quaternion",
          "angle",    "angular_velocity", "angular_acceleration", "accelerometer",   "force",
          "moment",   "load_cell_force",  "load_cell_moment",     "modal",           "energy"};
}

constexpr Key kKeys[] = {
    Key::text("name", kRequired, "Name of the channel"),
    Key::text("quantity", kRequired, "Quantity that is recorded", {.choices = quantities}),
    Key::text("marker", kNone, "Marker whose motion is recorded"),
    Key::text("joint", kNone, "Joint whose load is recorded"),
    Key::text("body", kNone, "Deformable body whose modal coordinates are recorded"),
    Key::text("relative_to", kNone,
              "Marker relative to whose moving frame the motion is measured (default: the world)"),
    Key::text("axes", kNone,
              "Marker in whose axes the components are resolved (default: those of relative_to)"),
    Key::numbers("axis", kNone, "Axis of the angle", {.size = 3}),
    Key::text("filter", kNone, "Channel frequency class of the SAE J211 filter",
              {.choices = channel_class_names}),
};

std::optional<std::size_t> marker_or_none(const StudyTable& table, const std::string& key,
                                          const Model& model) {
  if (!table.has(key)) return std::nullopt;
  return reference(table, key, names_of(model.markers), "marker");
}

/// Axis of a joint or an angle, given in a marker's axes, in the world at the start.
Eigen::Vector3d in_world(const Model& model, std::optional<std::size_t> marker,
                         const Eigen::Vector3d& axis) {
  if (!marker) return axis;
  const multibody::Marker& of = model.markers[*marker];
  return (pose_of(model.bodies[of.body]) * marker_pose(model, of)).rotation * axis;
}

/// Start angle of the joint that turns one body relative to the other about the axis, if there is
/// one.
double start_of(const multibody::MeasuredAngle& angle, const Model& model) {
  const auto body = [&](std::size_t marker) { return model.markers[marker].body; };
  const auto measures_from = [&](std::size_t marker) {
    if (angle.relative_to) return body(marker) == body(*angle.relative_to);
    return std::holds_alternative<multibody::PrescribedBody>(model.bodies[body(marker)].kind);
  };
  const Eigen::Vector3d axis = in_world(model, angle.relative_to, angle.axis);
  for (const multibody::Joint& joint : model.joints) {
    const bool outwards =
        body(joint.marker_j) == body(angle.marker) && measures_from(joint.marker_i);
    const bool inwards =
        body(joint.marker_i) == body(angle.marker) && measures_from(joint.marker_j);
    if (!joint.kind->has_angle || !(outwards || inwards)) continue;
    const double along = axis.dot(in_world(model, joint.marker_i, joint.axis));
    constexpr double kParallel = 1 - 1e-9;
    if (std::abs(along) < kParallel) continue;
    return outwards == (along > 0) ? joint.start_angle_rad : -joint.start_angle_rad;
  }
  return 0;
}

void read_angle_channel(const StudyTable& table, Model& model, ChannelSpec& spec) {
  multibody::MeasuredAngle angle{
      .name = spec.name,
      .marker = reference(table, "marker", names_of(model.markers), "marker"),
      .relative_to = marker_or_none(table, "relative_to", model),
      .axis = unit_vector(table, "axis")};
  angle.start_rad = start_of(angle, model);
  spec.source = model.angles.size();
  model.angles.push_back(std::move(angle));
}

void read_marker_channel(const StudyTable& table, const Model& model, ChannelSpec& spec) {
  spec.source = reference(table, "marker", names_of(model.markers), "marker");
  if (spec.quantity == Quantity::accelerometer) return;
  spec.relative_to = marker_or_none(table, "relative_to", model);
  const bool is_rotation =
      spec.quantity == Quantity::quaternion || spec.quantity == Quantity::rotation_vector;
  if (!is_rotation) spec.axes = marker_or_none(table, "axes", model);
}

std::size_t deformable_body(const StudyTable& table, const Model& model) {
  std::vector<std::string> names;
  for (const multibody::Body& body : model.bodies)
    if (std::holds_alternative<multibody::DeformableBody>(body.kind)) names.push_back(body.name);
  return reference(table, "body", names, "deformable body");
}

std::optional<ChannelClass> read_filter(const StudyTable& table, double interval_s) {
  if (!table.has("filter")) return std::nullopt;
  const ChannelClass cfc = read_channel_class(table, "filter");
  try {  // The filter itself checks its requirements.
    multibody::cfc_filtered(Eigen::Vector2d::Zero(), interval_s, cfc);
  } catch (const InputError& error) {
    table.refuse("filter", error.what());
  }
  return cfc;
}

}  // namespace

std::span<const Key> channel_keys() { return kKeys; }

ChannelSpec read_channel(const StudyTable& table, Model& model, double interval_s) {
  ChannelSpec spec;
  spec.name = table.text("name");
  spec.quantity = static_cast<Quantity>(table.choice("quantity"));
  switch (spec.quantity) {
    case Quantity::force:
    case Quantity::moment:
    case Quantity::load_cell_force:
    case Quantity::load_cell_moment:
      spec.source = reference(table, "joint", names_of(model.joints), "joint");
      if (spec.quantity == Quantity::force || spec.quantity == Quantity::moment)
        spec.axes = marker_or_none(table, "axes", model);
      if (spec.axes) spec.relative_to = model.joints[spec.source].marker_i;
      break;
    case Quantity::modal:
      spec.source = deformable_body(table, model);
      break;
    case Quantity::angle:
      read_angle_channel(table, model, spec);
      break;
    case Quantity::energy:
      break;
    default:
      read_marker_channel(table, model, spec);
  }
  spec.filter = read_filter(table, interval_s);
  table.finish();
  return spec;
}

}  // namespace flexneck::pipeline
