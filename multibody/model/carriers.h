// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// For each body of a model, the initial velocity of the prescribed body to which it is connected,
/// directly or through others, m/s: by joints, or by force elements that resist every motion
/// (HoldingForce). None for an unconnected body.
/// @throws InputError if a body is connected to prescribed ones of different velocity.
std::vector<std::optional<Eigen::Vector3d>> carrier_velocities(const Model& model);

/// Checks that every free body is connected.
/// @throws InputError for a free body that is not: it has no equilibrium.
void check_no_body_floats(const Model& model);

}  // namespace flexneck::multibody
