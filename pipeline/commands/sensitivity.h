// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/provenance.h"
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

/// What `modes --sensitivity` cannot be asked for together with.
/// @throws InputError with the key that it does not go with.
void check_sensitivity(const Study& study);

/// Derivatives of what `modes` has found, by all dimensions and material constants:
/// sensitivities.json, and a table.
/// @param fields of the same solution as the body
/// @param provenance of the modes
void write_sensitivities(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& options, const fe_modal::ModalBody& body,
                         const fe_modal::AnalysisFields& fields, Provenance provenance);

}  // namespace flexneck::pipeline
