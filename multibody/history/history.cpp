// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/history.h"

#include "geometry/foundation/names.h"

namespace flexneck::multibody {

const MarkerHistory& History::marker(const std::string& name) const {
  return markers[find_name(names_of(markers), name, "marker")];
}

const JointHistory& History::joint(const std::string& name) const {
  return joints[find_name(names_of(joints), name, "joint")];
}

}  // namespace flexneck::multibody
