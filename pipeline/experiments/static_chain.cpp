// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/static_chain.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/model/placement.h"

namespace flexneck::pipeline {

using multibody::Model;

namespace {

/// The deformable body of the case.
const BodySection& neck_of(const Study& study, const CaseSection& experiment) {
  for (const std::string& name : experiment.bodies)
    if (study.body(name).kind == BodySection::Kind::deformable) return study.body(name);
  throw InputError("case." + experiment.name + ": there is no deformable body to cut");
}

/// The ends of the neck keep their names.
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

}  // namespace

Model static_chain_model(const Study& study, const CaseSection& experiment,
                         const std::vector<ChainLink>& links) {
  const std::string neck = neck_of(study, experiment).name;
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
  for (const std::string& name : experiment.forces)
    model.forces.add(
        point_force(study.forces[find_name(names_of(study.forces), name, "force")], model));
  std::vector<bool> placed(model.bodies.size(), false);
  placed[0] = true;
  place_bodies(model, std::vector<JointStart>(model.joints.size()), std::move(placed));
  return model;
}

}  // namespace flexneck::pipeline
