// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/model.h"

#include "fe_modal/body/skew.h"
#include "geometry/foundation/names.h"

namespace flexneck::multibody {
namespace {

Eigen::VectorXd inertia_of(double mass, const Eigen::Vector3d& S, const Eigen::Matrix3d& J) {
  Eigen::VectorXd inertia(10);
  inertia << mass, S, J.diagonal(), J(0, 1), J(0, 2), J(1, 2);
  return inertia;
}

}  // namespace

Eigen::VectorXd inertia_of(const Body& body) {
  if (const auto* deformable = std::get_if<DeformableBody>(&body.kind)) {
    const fe_modal::InertiaInvariants& inertia = deformable->modes.invariants;
    return inertia_of(inertia.mass, inertia.S1, inertia.J0);
  }
  const auto& rigid = std::get<RigidBody>(body.kind);
  const Eigen::Matrix3d arm = skew(rigid.center_m);
  return inertia_of(rigid.mass_kg, rigid.mass_kg * rigid.center_m,
                    rigid.inertia_kg_m2 - rigid.mass_kg * arm * arm);
}

std::size_t Model::body_index(const std::string& name) const {
  return find_name(names_of(bodies), name, "body");
}

std::size_t Model::marker_index(const std::string& name) const {
  return find_name(names_of(markers), name, "marker");
}

std::size_t Model::joint_index(const std::string& name) const {
  return find_name(names_of(joints), name, "joint");
}

Eigen::VectorXd initial_modal(const DeformableBody& body) {
  if (body.initial_modal.size() > 0) return body.initial_modal;
  return body.offset.size() > 0 ? body.offset : Eigen::VectorXd::Zero(body.modes.mode_count());
}

Eigen::VectorXd initial_modal_rate(const DeformableBody& body) {
  return body.initial_modal_rate.size() > 0 ? body.initial_modal_rate
                                            : Eigen::VectorXd::Zero(body.modes.mode_count());
}

}  // namespace flexneck::multibody
