// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// The options with the displacements of the static step under their prestress loads, so that
/// systems made with them have the stiffness K + K_g(sigma); without such loads the options as they
/// are.
/// @throws InputError for more than one rank, and as static_step() does.
ModalOptions with_prestress(const mesher::Mesh& mesh, ModalOptions options,
                            const Progress& progress);

/// A sentence on a static step that is beyond small displacements: a strain above 0.1 or a turn
/// above 0.3 rad somewhere in the body, which errs by a tenth or a twentieth; empty below.
/// @param options of with_prestress()
std::string large_prestress_text(const mesher::Mesh& mesh, const ModalOptions& options);

/// Smallest positive factor of the options' prestress at which the body buckles, K + factor K_g
/// singular; nothing if there is none up to 1000.
/// @param options of with_prestress()
std::optional<double> buckling_factor(const mesher::Mesh& mesh, const DofMap& dof_map,
                                      const ModalOptions& options);

/// (K + K_g)^-1 of a prestressed system.
/// @throws InputError with the factor at which it buckles, if that is not above 1.
/// @throws ComputationError as ModalSystem::shift_inverse().
std::unique_ptr<const ShiftInverse> factorise_prestressed(const mesher::Mesh& mesh,
                                                          const DofMap& dof_map,
                                                          const AssembledSystem& system,
                                                          const ModalOptions& options);

/// The options' prestress loads in words; empty without any.
std::string prestress_text(const ModalOptions& options);

}  // namespace flexneck::fe_modal
