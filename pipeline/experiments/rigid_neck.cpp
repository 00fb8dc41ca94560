// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/rigid_neck.h"

#include <algorithm>
#include <numbers>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/bending_plane.h"

namespace flexneck::pipeline {

using Eigen::Vector3d;
using multibody::Model;

namespace {

multibody::RigidBody rigid_body_of(const fe_modal::InertiaInvariants& invariants) {
  multibody::RigidBody rigid;
  rigid.mass_kg = invariants.mass;
  rigid.center_m = invariants.S1 / invariants.mass;
  const Vector3d& c = rigid.center_m;
  rigid.inertia_kg_m2 =
      invariants.J0 -
      rigid.mass_kg * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return rigid;
}

/// Linear spring, the same in both directions, with a damper.
multibody::Resistance spring_and_damper(double stiffness, double damping_time_s) {
  multibody::Resistance resistance;
  resistance.positive.curve = resistance.negative.curve = multibody::LoadCurve::cubic(stiffness);
  resistance.damping = stiffness * damping_time_s;
  return resistance;
}

/// Compliances of the top in the plane, and the damping of the first mode there.
struct PlaneCompliance {
  double uF = 0, uM = 0, tM = 0;
  double damping_time_s = 0;
};

PlaneCompliance compliance(const multibody::DeformableBody& neck, const BendingPlane& plane) {
  const fe_modal::Interface& top = neck.modes.interface("top");
  PlaneCompliance sum;
  double largest = 0;
  for (Eigen::Index k = 0; k < neck.modes.mode_count(); ++k) {
    const double omega = 2 * std::numbers::pi * neck.modes.frequencies_Hz[k];
    const double u = plane.tip.dot(top.translation.col(k)) / omega;
    const double t = plane.axis.dot(top.rotation.col(k)) / omega;
    sum.uF += u * u;
    sum.uM += u * t;
    sum.tM += t * t;
    // The first mode in the plane is the most compliant one.
    if (u * u <= largest) continue;
    largest = u * u;
    sum.damping_time_s = 2 * neck.damping_ratio[k] / omega;
  }
  return sum;
}

}  // namespace

RigidNeck equivalent_neck(const multibody::DeformableBody& neck, CaseSection::Direction direction) {
  const PlaneCompliance c = compliance(neck, bending_plane(direction));
  const double top_m = neck.modes.interface("top").position_m.z();
  if (!(c.uF > 0) || !(c.uM > 0))
    throw InputError("none of the selected modes of the neck bends it in the plane of the case");
  const double length_m = c.uF / c.uM;
  const double lower = c.uF / (c.uM * c.uM);
  const double upper_compliance = c.tM - 1 / lower;
  if (length_m > top_m || !(upper_compliance > 0))
    throw InputError("no link with two springs has the static stiffness of the neck's modes");
  RigidNeck result;
  result.rigid = rigid_body_of(neck.modes.invariants);
  result.lower.height_m = top_m - length_m;
  result.lower.resistance = spring_and_damper(lower, c.damping_time_s);
  result.upper.height_m = top_m;
  result.upper.resistance = spring_and_damper(1 / upper_compliance, c.damping_time_s);
  return result;
}

void put_rigid_neck(const RigidNeck& neck, CaseSection::Direction direction, std::size_t index,
                    Model& model) {
  const BendingPlane plane = bending_plane(direction);
  model.bodies[index].kind = neck.rigid;
  const std::string name = model.bodies[index].name;
  const auto place_marker = [&](const std::string& interface, double height_m) {
    multibody::Marker& marker = model.markers[model.marker_index(name + "." + interface)];
    marker.interface.clear();
    marker.position_m = Vector3d(0, 0, height_m);
  };
  place_marker("base", 0);
  place_marker("top", neck.upper.height_m);
  const auto add_marker = [&](std::size_t body, const Vector3d& position_m) {
    multibody::Marker marker;
    marker.name = model.bodies[body].name + ".pivot";
    marker.body = body;
    marker.position_m = position_m;
    model.markers.push_back(marker);
    return model.markers.size() - 1;
  };
  const auto add_pin = [&](std::size_t joint, const RigidNeck::Pivot& pivot) {
    model.joints[joint].kind = &multibody::kRevoluteJoint;
    model.joints[joint].axis = plane.axis;
    model.forces.add(multibody::JointResistance{"pivot of " + model.joints[joint].name, joint,
                                                multibody::JointCoordinate::angle,
                                                pivot.resistance});
  };
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    multibody::Joint& joint = model.joints[k];
    const multibody::Marker lower = model.markers[joint.marker_i];
    const multibody::Marker upper = model.markers[joint.marker_j];
    if (upper.body == index) {
      const Vector3d step(0, 0, neck.lower.height_m);
      joint.marker_i = add_marker(lower.body, lower.position_m + step);
      joint.marker_j = add_marker(index, step);
      add_pin(k, neck.lower);
    } else if (lower.body == index) {
      add_pin(k, neck.upper);
    }
  }
}

namespace {

const multibody::Resistance* angle_resistance(const Model& model, std::size_t joint) {
  for (const multibody::JointResistance& each : model.forces.of<multibody::JointResistance>())
    if (each.joint == joint && each.coordinate == multibody::JointCoordinate::angle)
      return &each.resistance;
  return nullptr;
}

}  // namespace

bool has_rigid_neck(const CaseSection& experiment) {
  const std::vector<multibody::Body>& bodies = experiment.model.model.bodies;
  return experiment.equivalent_rigid_neck ||
         std::none_of(bodies.begin(), bodies.end(), [](const multibody::Body& body) {
           return std::holds_alternative<multibody::DeformableBody>(body.kind);
         });
}

std::optional<RigidNeck> rigid_neck_in(const Model& model) {
  RigidNeck neck;
  const multibody::RigidBody* link = nullptr;
  const multibody::Resistance* lower = nullptr;
  const multibody::Resistance* upper = nullptr;
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const multibody::Marker& below = model.markers[model.joints[k].marker_i];
    const multibody::Marker& above = model.markers[model.joints[k].marker_j];
    if (model.joints[k].kind != &multibody::kRevoluteJoint) return {};
    if (std::holds_alternative<multibody::PrescribedBody>(model.bodies[below.body].kind)) {
      link = std::get_if<multibody::RigidBody>(&model.bodies[above.body].kind);
      neck.lower.height_m = above.position_m.z();
      lower = angle_resistance(model, k);
    } else if (above.name == "head.condyles") {
      neck.upper.height_m = below.position_m.z();
      upper = angle_resistance(model, k);
    }
  }
  if (link == nullptr || lower == nullptr || upper == nullptr) return {};
  neck.rigid = *link;
  neck.lower.resistance = *lower;
  neck.upper.resistance = *upper;
  return neck;
}

}  // namespace flexneck::pipeline
