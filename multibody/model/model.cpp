// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/model.h"

#include "geometry/foundation/names.h"

namespace flexneck::multibody {

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
