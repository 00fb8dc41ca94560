// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"
#include "geometry/foundation/step_times.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Normal modes by shift-invert, completed to the basis asked for, reduced to a modal body.
/// @param times takes the time of each step if it is not null
/// @param warn takes a line if the number of modes cuts a cluster of equal frequencies; may be
/// empty
/// @throws InputError for unknown sets, parts or interfaces, elements that have no such
/// formulation, more modes than degrees of freedom, a basis that the boundary does not allow, more
/// than memory holds, or a body that is a mechanism: the message names the parts that move without
/// strain, and how.
/// @throws ComputationError if the factorisation or the eigensolver fails, or if a mode is missing.
ModalBody analyse_modes(const mesher::Mesh& mesh, const ModalOptions& options,
                        const Progress& progress, StepTimes* times = nullptr,
                        const Progress& warn = {});

}  // namespace flexneck::fe_modal
