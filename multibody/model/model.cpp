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

}  // namespace flexneck::multibody
