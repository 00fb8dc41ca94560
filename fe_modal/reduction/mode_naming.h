// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// Energy fractions of fore-aft (x with theta_y), lateral (y with theta_x), twist (theta_z) and
/// axial (z) motion.
using Shares = std::array<double, 4>;

/// Energy fractions, per cent, of the four kinds of motion in a mode's kinetic energy of the rigid
/// motions of some parts. Each part moves with its mass-weighted average motion; products of
/// inertia count half for each of their axes. All zero if the parts do not move.
/// @param shape shape of a mode on all nodes, (3, n)
Shares motion_shares(const std::vector<RigidAverage>& parts, const Eigen::Matrix3Xd& shape);

/// Names by the largest share, counted by kind: "fore-aft bending 1", "lateral bending 1",
/// "torsion 1", "axial 1"; modes without shares are "mode 1", "mode 2", …
std::vector<std::string> mode_names(const std::vector<Shares>& shares);
/// Names as above, with corrections (basis_kind.h) named by their kind: "residual 1", "residual 2",
/// …
std::vector<std::string> mode_names(const std::vector<Shares>& shares,
                                    const std::vector<std::string>& kinds);

}  // namespace flexneck::fe_modal
