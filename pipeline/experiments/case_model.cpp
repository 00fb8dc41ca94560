// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/case_model.h"

#include <algorithm>
#include <optional>

#include "fe_modal/body/basis_kind.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/rigid_neck.h"
#include "pipeline/model/placement.h"

namespace flexneck::pipeline {

using multibody::Marker;
using multibody::Model;
using multibody::TimeTable;

namespace {

multibody::DeformableBody deformable(const BodySection& section, const fe_modal::ModalBody& body) {
  multibody::DeformableBody result;
  result.modes = fe_modal::select_modes(body, section.modes);
  result.damping_ratio.resize(result.modes.mode_count());
  for (Eigen::Index k = 0; k < result.damping_ratio.size(); ++k) {
    const bool correction =
        fe_modal::is_correction(result.modes.modes[static_cast<std::size_t>(k)].kind);
    result.damping_ratio[k] = correction ? section.correction_damping_ratio : section.damping_ratio;
  }
  return result;
}

void add_body(Model& model, const BodySection& section, const fe_modal::ModalBody& body) {
  multibody::Body added;
  added.name = section.name;
  switch (section.kind) {
    case BodySection::Kind::ground:
    case BodySection::Kind::prescribed:
      added.kind = multibody::PrescribedBody();
      break;
    case BodySection::Kind::rigid:
      added.kind = section.rigid;
      break;
    case BodySection::Kind::deformable:
      added.kind = deformable(section, body);
      for (const fe_modal::Interface& interface : body.interfaces) {
        Marker marker;
        marker.name = section.name + "." + interface.name;
        marker.body = model.bodies.size();
        marker.interface = interface.name;
        model.markers.push_back(marker);
      }
      break;
  }
  model.bodies.push_back(std::move(added));
}

/// Bodies that stand or are prescribed are turned, the others placed by the joints.
void place(Model& model, const Eigen::Quaterniond& rotation, const std::string& case_name) {
  std::vector<bool> placed(model.bodies.size(), false);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    placed[i] = std::holds_alternative<multibody::PrescribedBody>(model.bodies[i].kind);
    if (placed[i]) model.bodies[i].initial_pose.rotation = rotation;
  }
  try {
    place_bodies(model, std::vector<JointStart>(model.joints.size()), std::move(placed));
  } catch (const InputError& error) {
    throw InputError("case." + case_name + ": " + error.what());
  }
}

/// The deformable body of a case, if it has one.
std::optional<std::size_t> deformable_body(const Model& model) {
  for (std::size_t k = 0; k < model.bodies.size(); ++k)
    if (std::holds_alternative<multibody::DeformableBody>(model.bodies[k].kind)) return k;
  return {};
}

/// The section that a case names, made equivalent to the deformable neck if it says so.
RigidNeckSection rigid_neck_for(const Study& study, const CaseSection& experiment,
                                const multibody::DeformableBody& neck) {
  const RigidNeckSection& section =
      study
          .rigid_necks[find_name(names_of(study.rigid_necks), experiment.rigid_neck, "rigid_neck")];
  return section.is_equivalent ? equivalent_neck(neck, experiment.direction) : section;
}

/// The neck of the older model in place of the deformable one.
void replace_neck(const Study& study, const CaseSection& experiment, Model& model) {
  const std::optional<std::size_t> index = deformable_body(model);
  if (!index)
    throw InputError("case." + experiment.name +
                     ": rigid_neck: there is no deformable body in whose place to put it");
  try {
    const RigidNeckSection neck = rigid_neck_for(
        study, experiment, std::get<multibody::DeformableBody>(model.bodies[*index].kind));
    put_rigid_neck(neck, experiment.direction, *index, model);
  } catch (const InputError& error) {
    throw InputError("case." + experiment.name + ": rigid_neck: " + error.what());
  }
}

/// A pin with its spring in place of the joint that holds the head.
void put_head_spring(const HeadSpringSection& spring, Model& model) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    multibody::Joint& joint = model.joints[k];
    if (model.markers[joint.marker_j].name != "head.condyles") continue;
    joint.kind = &multibody::kRevoluteJoint;
    joint.axis = spring.axis;
    model.forces.add(multibody::JointResistance{spring.name, k, multibody::JointCoordinate::angle,
                                                spring.resistance});
  }
}

/// The part of a marker's name before the dot.
std::string body_of(const std::string& marker) { return marker.substr(0, marker.find('.')); }

}  // namespace

multibody::PointForce point_force(const ForceSection& section, const Model& model) {
  multibody::PointForce force;
  force.name = section.name;
  force.marker = model.marker_index(section.marker);
  force.direction = section.direction;
  force.magnitude_N =
      TimeTable(section.times_s, section.magnitudes_N, TimeTable::Outside::constant);
  return force;
}

RigidNeckSection rigid_neck_of(const Study& study, const CaseSection& experiment,
                               const fe_modal::ModalBody& body) {
  for (const std::string& name : experiment.bodies) {
    const BodySection& section = study.body(name);
    if (section.kind == BodySection::Kind::deformable)
      return rigid_neck_for(study, experiment, deformable(section, body));
  }
  throw InputError("case." + experiment.name + ": rigid_neck: there is no deformable body");
}

Model case_model(const Study& study, const CaseSection& experiment, const fe_modal::ModalBody& body,
                 const Eigen::Quaterniond& rotation) {
  Model model;
  const auto in_case = [&](const std::string& name) {
    return std::find(experiment.bodies.begin(), experiment.bodies.end(), name) !=
           experiment.bodies.end();
  };
  for (const std::string& name : experiment.bodies) add_body(model, study.body(name), body);
  for (const MarkerSection& section : study.markers) {
    if (!in_case(section.body)) continue;
    Marker marker;
    marker.name = section.name;
    marker.body = model.body_index(section.body);
    marker.position_m = section.position_m;
    model.markers.push_back(marker);
  }
  for (const JointSection& section : study.joints) {
    if (!in_case(body_of(section.marker_i)) || !in_case(body_of(section.marker_j))) continue;
    multibody::Joint joint;
    joint.name = section.name;
    joint.kind = section.kind;
    joint.marker_i = model.marker_index(section.marker_i);
    joint.marker_j = model.marker_index(section.marker_j);
    joint.axis = section.axis;
    model.joints.push_back(joint);
  }
  for (const std::string& name : experiment.forces) {
    model.forces.add(
        point_force(study.forces[find_name(names_of(study.forces), name, "force")], model));
  }
  if (!experiment.rigid_neck.empty()) replace_neck(study, experiment, model);
  if (!experiment.head_spring.empty())
    put_head_spring(study.head_springs[find_name(names_of(study.head_springs),
                                                 experiment.head_spring, "head_spring")],
                    model);
  place(model, rotation, experiment.name);
  return model;
}

}  // namespace flexneck::pipeline
