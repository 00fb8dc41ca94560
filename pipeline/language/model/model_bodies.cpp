// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/modes_path.h"
#include "pipeline/language/model/rigid_body.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

using multibody::DeformableBody;
using multibody::PrescribedBody;
using multibody::RigidBody;

namespace {

std::vector<std::string> kinds() { return {"ground", "prescribed", "rigid", "deformable"}; }

constexpr auto kOwnKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the body"),
        Key::text("kind", kRequired, "Kind of body", {.choices = kinds}),
        Key::quantities("position", "m", kNone,
                        "Initial position of the body frame, in the world; if neither position nor "
                        "rotation is given, the joints determine both",
                        {.size = 3}),
        Key::quantities("rotation", "rad", kNone,
                        "Initial rotation of the body frame, as a rotation vector", {.size = 3}),
        Key::quantities("velocity", "m/s", kNone,
                        "Initial velocity of the body's origin, in the world; if neither velocity "
                        "nor angular_velocity is given, the body moves with the body that carries "
                        "it, or as nearly so as loops and motors allow",
                        {.size = 3}),
        Key::quantities("angular_velocity", "rad/s", kNone,
                        "Initial angular velocity, in the body's axes", {.size = 3}),
        Key::quantities("inertia_rotation", "rad", kNone,
                        "Rotation of the axes of inertia of a rigid body relative to its frame",
                        {.size = 3}),
        Key::flag("lumped", "false",
                  "Instead of mass, center and inertia of a rigid body: the mass of the "
                  "substructures whose sections are attached to it, each lumped at its two ends"),
        Key::file(
            "modes_file", kNone,
            "Modes file of a deformable body (default in a study: the modes of its structure)"),
        kMadeByKey,
    }),
    kRigidBodyKeys);

/// Checks mass and inertia early; in a study they would otherwise be checked only after its modes
/// are computed.
void check_alone(const StudyTable& table, const RigidBody& body) {
  multibody::Model alone;
  alone.bodies.push_back({table.text("name"), body, {}});
  at_key(table, "name", [&] { multibody::check(alone); });
}

/// Reads a rigid body; the inertia's axes may be rotated against the body's.
RigidBody rigid_body(const StudyTable& table, Assembly& assembly) {
  if (table.flag("lumped")) {
    table.refuse_given({"mass", "center", "inertia", "inertia_rotation"},
                       "the body takes its mass from the sections attached to it");
    assembly.lumped.insert(assembly.model.bodies.size());
    return {0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  }
  RigidBody body = read_rigid(table);
  const Eigen::Matrix3d R = rotation_or_none(table, "inertia_rotation").toRotationMatrix();
  body.inertia_kg_m2 = R * body.inertia_kg_m2 * R.transpose();
  check_alone(table, body);
  return body;
}

DeformableBody deformable_body(const StudyTable& table, Assembly& assembly) {
  const ModesUse use = read_modes_use(table);
  if (assembly.structure && !table.has("modes_file")) {
    DeformableBody body;
    for (const std::string& name : *assembly.structure)
      body.modes.interfaces.push_back(
          {.name = name, .position_m = {}, .translation = {}, .rotation = {}});
    assembly.of_structure.insert_or_assign(assembly.model.bodies.size(), use);
    return body;
  }
  const std::filesystem::path path = modes_path(table, "modes_file");
  return use_modes(use, read_modal_body(path).body, path.string());
}

void add_interfaces(multibody::Model& model, std::size_t index) {
  const multibody::Body& body = model.bodies[index];
  for (const fe_modal::Interface& interface :
       std::get<DeformableBody>(body.kind).modes.interfaces) {
    multibody::Marker marker;
    marker.name = body.name + "." + interface.name;
    marker.body = index;
    marker.interface = interface.name;
    model.markers.push_back(marker);
  }
}

/// Reads the body's initial pose and velocity, as far as the file gives them.
void read_start(const StudyTable& table, bool is_free, Assembly& assembly) {
  multibody::Body& body = assembly.model.bodies.back();
  const bool posed = table.has("position") || table.has("rotation");
  if (table.has("position")) body.initial_pose.position_m = quantity_vector(table, "position");
  body.initial_pose.rotation =
      is_free || table.has("rotation") ? rotation_or_none(table, "rotation") : assembly.rotation;
  assembly.posed.push_back(posed || !is_free);
  const bool moving = is_free && (table.has("velocity") || table.has("angular_velocity"));
  if (moving && table.has("velocity"))
    body.initial_velocity_m_s = quantity_vector(table, "velocity");
  if (moving && table.has("angular_velocity"))
    body.initial_angular_velocity_rad_s = quantity_vector(table, "angular_velocity");
  assembly.moving.push_back(moving);
}

constexpr Key kMarkerKeys[] = {
    Key::text("body", kRequired, "Body that carries the marker"),
    Key::text("name", kRequired, "Name of the marker, which is referred to as body.name"),
    Key::quantities("position", "m", kNone, "Position in the body's frame", {.size = 3}),
    Key::text("interface", kNone,
              "Instead of position: interface of a deformable body with which the marker moves"),
    Key::quantities("rotation", "rad", kNone,
                    "Rotation of the marker's axes relative to the body's, as a rotation vector",
                    {.size = 3}),
};

void read_body(const StudyTable& table, Assembly& assembly) {
  multibody::Body body;
  body.name = table.text("name");
  const std::size_t kind = table.choice("kind");
  switch (kind) {
    case 0:
      body.kind = PrescribedBody();
      break;
    case 1:
      body.kind = prescribed_body(table, assembly);
      assembly.prescribed.push_back(assembly.model.bodies.size());
      break;
    case 2:
      body.kind = rigid_body(table, assembly);
      break;
    default:
      body.kind = deformable_body(table, assembly);
      break;
  }
  assembly.model.bodies.push_back(std::move(body));
  read_start(table, kind >= 2, assembly);
  if (kind == 3) add_interfaces(assembly.model, assembly.model.bodies.size() - 1);
  table.finish();
}

void read_marker(const StudyTable& table, Assembly& assembly) {
  multibody::Model& model = assembly.model;
  multibody::Marker marker;
  marker.body = reference(table, "body", names_of(model.bodies), "body");
  const multibody::Body& body = model.bodies[marker.body];
  marker.name = body.name + "." + table.text("name");
  if (const auto* deformable = std::get_if<DeformableBody>(&body.kind)) {
    const std::vector<std::string> names = names_of(deformable->modes.interfaces);
    marker.interface = names[reference(table, "interface", names, "interface")];
  } else {
    marker.position_m = quantity_vector(table, "position");
  }
  marker.rotation = rotation_or_none(table, "rotation");
  model.markers.push_back(std::move(marker));
  table.finish();
}

}  // namespace

void attach(const fe_modal::ModalBody& structure, Assembly& assembly) {
  for (const auto& [body, use] : assembly.of_structure)
    assembly.model.bodies[body].kind = use_modes(use, structure, "the study's structure");
  assembly.of_structure.clear();
}

ModelSection body_section() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(kOwnKeys.begin(), kOwnKeys.end());
    for (const std::span<const Key> more : {modes_use_keys(), prescribed_body_keys()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return {Key::tables("body", "Bodies", keys), read_body};
}

ModelSection marker_section() {
  return {Key::tables("marker",
                      "Markers: points with axes on bodies; the interfaces of deformable bodies "
                      "are markers too",
                      kMarkerKeys),
          read_marker};
}

}  // namespace flexneck::pipeline
