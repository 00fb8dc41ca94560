// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/basis_kind.h"

namespace flexneck::fe_modal {

const std::vector<std::string>& basis_names() {
  static const std::vector<std::string> names = {"normal", "residual", "craig-bampton",
                                                 "inertia-relief"};
  return names;
}

const std::vector<std::string>& slit_motion_names() {
  static const std::vector<std::string> names = {"cracks", "openings", "openings-and-sliding"};
  return names;
}

bool is_correction(std::string_view kind) {
  return kind == kResidualMode || kind == kReliefMode || kind == kConstraintMode;
}

}  // namespace flexneck::fe_modal
