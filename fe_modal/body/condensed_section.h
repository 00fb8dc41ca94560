// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A body between two rigid faces as an element of a chain: stiffness and mass in the motions of
/// its base and of its top, each translation (3) and rotation (3), body axes. SI units.
struct CondensedSection {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< where the base's motion is measured
  Eigen::Vector3d top_m = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 12, 12> stiffness = Eigen::Matrix<double, 12, 12>::Zero();
  Eigen::Matrix<double, 12, 12> mass = Eigen::Matrix<double, 12, 12>::Zero();
};

/// Static condensation (Guyan, AIAA J. 3 (1965) 380) of a body whose base is fixed and whose modes
/// are the static shapes of one interface: the base's rigid motion and the six modes become the
/// motions of base and top. Small motions about the undeformed shape.
/// @param base  the interface on the fixed nodes
/// @param top   the other
/// @throws InputError unless there are six modes, and unless they move the top in six independent
/// ways.
CondensedSection condense(const ModalBody& body, const std::string& base, const std::string& top);

}  // namespace flexneck::fe_modal
