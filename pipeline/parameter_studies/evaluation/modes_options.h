// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/system/modal_options.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Options of the solution, which apply to a mesh and to matrices.
fe_modal::ModalOptions options_of_solution(const Study& study);

/// Options of the analysis for `flexneck modes`, from [modes] and [[interface]]. An interface on a
/// fixed set is the fixed interface. If several sets are fixed, their union is added to the mesh as
/// the node set "fixed". The modes' signs are chosen by the first other interface. The study's
/// other supports and couplings are added to the mesh (study_connections.h).
/// @throws InputError naming study and key, with the nearest set if one is unknown.
fe_modal::ModalOptions modes_options(const Study& study, mesher::Mesh& mesh);

/// Formulation of each material: its own, or the one in [modes].
fe_modal::FormulationChoice formulation_of(const Study& study);

}  // namespace flexneck::pipeline
