// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/linear_solver.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Fails for a body whose stiffness is not definite.
/// @throws InputError that names the parts that move without strain, and how.
/// @throws ComputationError if there are none that move as rigid bodies.
[[noreturn]] void refuse_mechanism(const AssembledSystem& system, bool is_fixed);

/// Factorises K - shift M. If it is not positive definite, the body is a mechanism or its elements
/// are in error.
/// @throws InputError naming the parts that move without strain, and how.
/// @throws ComputationError as LinearSolver if there is no such motion.
std::unique_ptr<const LinearSolver> factorise_or_refuse(const AssembledSystem& system,
                                                        double shift);

}  // namespace flexneck::fe_modal
