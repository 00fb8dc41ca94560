// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/static_chain.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/language/model/placement.h"

namespace flexneck::pipeline {

using multibody::Model;

namespace {

/// Name of a link's marker: the ends of the neck keep the neck's names.
std::string marker_name(const std::string& neck, const std::string& link,
                        const std::string& interface) {
  return (interface == "base" || interface == "top" ? neck : link) + "." + interface;
}

std::size_t add_link(const std::string& neck, const ChainLink& link, Model& model) {
  multibody::Body body;
  body.name = link.name;
  body.kind = multibody::DeformableBody{link.body, Eigen::VectorXd::Zero(link.body.mode_count())};
  for (const fe_modal::Interface& interface : link.body.interfaces) {
    multibody::Marker marker;
    marker.name = marker_name(neck, link.name, interface.name);
    marker.body = model.bodies.size();
    marker.interface = interface.name;
    model.markers.push_back(marker);
  }
  model.bodies.push_back(std::move(body));
  return model.bodies.size() - 1;
}

void add_joint(const std::string& name, const std::string& lower, const std::string& upper,
               Model& model) {
  multibody::Joint joint;
  joint.name = name;
  joint.marker_i = model.marker_index(lower);
  joint.marker_j = model.marker_index(upper);
  model.joints.push_back(joint);
}

/// Fails if the case has springs, or bodies other than the neck and its support, which a chain does
/// not model.
void require_neck_alone(const CaseSection& experiment) {
  const Model& model = experiment.model.model;
  std::size_t forces = 0;
  model.forces.each_kind([&](const auto& elements) { forces += elements.size(); });
  if (model.bodies.size() != 2 || forces != model.forces.of<multibody::PointForce>().size())
    throw InputError("case." + experiment.name +
                     ": a chain of substructures can replace only a neck on the ground under "
                     "[[force]]; remove other bodies and springs, or [substructures]");
}

}  // namespace

Model static_chain_model(const CaseSection& experiment, const std::vector<ChainLink>& links) {
  require_neck_alone(experiment);
  const Model& whole = experiment.model.model;
  const std::string neck = whole.bodies[deformable_body(whole)].name;
  Model model;
  multibody::Body ground;
  ground.name = "ground";
  ground.kind = multibody::PrescribedBody();
  model.bodies.push_back(ground);
  multibody::Marker bench;
  bench.name = "ground.bench";
  model.markers.push_back(bench);
  for (const ChainLink& link : links) add_link(neck, link, model);
  add_joint("clamp", bench.name, neck + ".base", model);
  for (std::size_t k = 0; k + 1 < links.size(); ++k)
    add_joint("cut " + std::to_string(k + 1), links[k].name + ".to_" + links[k + 1].name,
              links[k + 1].name + ".to_" + links[k].name, model);
  for (multibody::PointForce force : whole.forces.of<multibody::PointForce>()) {
    force.marker = model.marker_index(whole.markers[force.marker].name);
    model.forces.add(std::move(force));
  }
  std::vector<bool> placed(model.bodies.size(), false);
  placed[0] = true;
  place_bodies(model, std::vector<JointStart>(model.joints.size()), std::move(placed));
  return model;
}

}  // namespace flexneck::pipeline
