// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Finds the displacements of the static step under the options' prestress loads, so that systems
/// of the model have the stiffness K + K_g(sigma); without such loads the model is not changed.
/// Each rank solves the whole static problem.
/// @throws InputError as static_step() does.
void add_prestress(Model& model, const Progress& progress);

/// Returns a sentence on a static step beyond small displacements: a strain above 0.1 or a rotation
/// above 0.3 rad somewhere in the body, with errors of a tenth or a twentieth; empty for smaller
/// ones.
/// @param model prestressed by add_prestress()
std::string large_prestress_text(const Model& model);

/// Smallest positive factor of the model's prestress at which the body buckles, K + factor K_g
/// singular; nothing if there is none up to 1000.
/// @param model prestressed by add_prestress()
std::optional<double> buckling_factor(const Model& model);

/// Factorises K + K_g of a prestressed system.
/// @throws InputError with the factor at which it buckles, if that is not above 1.
/// @throws ComputationError as LinearSolver.
std::unique_ptr<const LinearSolver> factorise_prestressed(const AssembledSystem& system);

/// The options' prestress loads in words; empty if there are none.
std::string prestress_text(const ModalOptions& options);

}  // namespace flexneck::fe_modal
