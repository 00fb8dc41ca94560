// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/linear_solver.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// @throws InputError that names the parts that move without strain, and how.
/// @throws ComputationError where there are none that move as rigid bodies.
[[noreturn]] void refuse_mechanism(const AssembledSystem& system, bool is_fixed);

/// (K - shift M)^-1. A stiffness that is not definite is that of a mechanism, or of elements that
/// are none.
/// @throws InputError naming the parts that move without strain, and how.
/// @throws ComputationError as LinearSolver where there is no such motion.
std::unique_ptr<const LinearSolver> factorise_or_refuse(const AssembledSystem& system,
                                                        double shift);

}  // namespace flexneck::fe_modal
