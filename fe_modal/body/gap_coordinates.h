// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A body whose slits open and close, with their openings g, m, as coordinates beside the modes.
struct GapBody {
  ModalBody modes;            ///< with the openings shut; their interfaces do not move with g
  Eigen::MatrixXd stiffness;  ///< of the openings, (g, g), N/m, the modal coordinates held
  Eigen::MatrixXd coupling;   ///< forces of the openings over modal coordinates, (g, m)
};

/// Other coordinates of the same body: openings g that move no interface, with the least energy
/// that these have, and the modes of what is left, in which sides that slide follow without load.
/// The energy is the same to the last digit; kinetic energy of openings is left out.
/// @param body  with SlitMotions in its basis
/// @throws InputError unless its modes move interfaces and slits independently of one another.
GapBody with_gap_coordinates(const ModalBody& body);

}  // namespace flexneck::fe_modal
