// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/bent_neck.h"

#include <algorithm>
#include <string>

#include "geometry/foundation/names.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::Vector3d;

std::optional<BentNeck> bent_neck(const multibody::History& history,
                                  const fe_modal::ModalBody& body, Index time) {
  if (history.modal.size() != 1) return {};
  const std::vector<std::string> names = names_of(body.modes);
  BentNeck bent{{}, history.modal.front().coordinates.col(time)};
  for (const std::string& mode : history.modal.front().modes) {
    const auto found = std::find(names.begin(), names.end(), mode);
    if (found == names.end()) return {};
    bent.modes.push_back(found - names.begin());
  }
  return bent;
}

Vector3d joint_of(const fe_modal::ModalBody& body, const BentNeck& bent) {
  const fe_modal::Interface& top = body.interface("top");
  return top.position_m + top.translation(Eigen::all, bent.modes) * bent.coordinates;
}

double tip_angle(const fe_modal::ModalBody& body, const BentNeck& bent) {
  return body.interface("top").rotation(1, bent.modes).dot(bent.coordinates);
}

}  // namespace flexneck::pipeline
