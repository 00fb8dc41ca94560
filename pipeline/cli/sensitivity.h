// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/provenance.h"
#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

/// Fails if the study asks for something that `modes --sensitivity` cannot be combined with.
/// @throws InputError naming the conflicting key.
void check_sensitivity(const Study& study);

/// Computes the derivatives of the modes by all dimensions and material constants; writes
/// sensitivities.json and prints a table.
/// @param fields fields of the same solution as the body
/// @param provenance provenance of the modes
void write_sensitivities(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& options, const fe_modal::ModalBody& body,
                         const fe_modal::AnalysisFields& fields, Provenance provenance);

}  // namespace flexneck::pipeline
