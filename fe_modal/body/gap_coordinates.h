// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A body whose slits open and close, with their openings g, m, as coordinates in addition to the
/// modes.
struct GapBody {
  ModalBody modes;  ///< modal body with the openings shut; its interfaces do not move with g
  /// Stiffness of the openings, (g, g), N/m, the modal coordinates fixed.
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd coupling;  ///< forces of the openings over modal coordinates, (g, m)
};

/// Transforms the coordinates of a body: openings g that move no interface, with the least energy,
/// and the modes of the remaining motions, in which sliding sides follow without load. The strain
/// energy is the same to the last digit; kinetic energy of openings is left out.
/// @param body  one with SlitMotions in its basis
/// @throws InputError unless its modes move interfaces and slits independently of one another.
GapBody with_gap_coordinates(const ModalBody& body);

}  // namespace flexneck::fe_modal
