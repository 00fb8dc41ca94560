// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "multibody/forces/internal_variables.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// Adds the errors of internal variables of force elements to an estimate, with the tolerance of
/// positions: distances relative to the system's size, angles to a radian.
/// @param first_component  component of the first block; each block has one
template <class Segment>
void consider_internal(const Segment& error, const std::vector<InternalBlock>& blocks,
                       double size_m, const Tolerance& tolerance, std::size_t first_component,
                       ErrorEstimate& worst) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto of_block = error.segment(blocks[k].begin, blocks[k].size);
    const double moved =
        std::hypot(of_block.template head<3>().norm(), of_block.tail(blocks[k].size - 6).norm());
    worst.consider(first_component + k, tolerance.ratio(moved, size_m));
    worst.consider(first_component + k, tolerance.ratio(of_block.template segment<3>(3).norm(), 1));
  }
}

}  // namespace flexneck::multibody
