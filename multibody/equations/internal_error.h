// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// Errors of internal variables of force elements, six a branch: against the tolerance as positions
/// are, distances against the system's size and angles against a radian.
/// @param first_component  of the first branch; one each
template <class Segment>
void consider_internal(const Segment& error, double size_m, const Tolerance& tolerance,
                       std::size_t first_component, ErrorEstimate& worst) {
  for (Eigen::Index at = 0; at < error.size(); at += 6) {
    const std::size_t component = first_component + static_cast<std::size_t>(at / 6);
    worst.consider(component, tolerance.ratio(error.template segment<3>(at).norm(), size_m));
    worst.consider(component, tolerance.ratio(error.template segment<3>(at + 3).norm(), 1));
  }
}

}  // namespace flexneck::multibody
