// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/system/modal_options.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// What is solved for and how, of a mesh or of matrices.
fe_modal::ModalOptions options_of_solution(const Study& study);

/// What `flexneck modes` computes: [modes] and [[interface]]. An interface on a set that is fixed
/// is the fixed interface. If several sets are fixed, their union joins the mesh as the node set
/// "fixed". Signs follow the first other interface.
/// What the study holds and joins otherwise is added to the mesh (study_connections.h).
/// @throws InputError naming study and key, with the nearest set where one is unknown.
fe_modal::ModalOptions modes_options(const Study& study, mesher::Mesh& mesh);

/// The formulation of each material: its own, or that of [modes].
fe_modal::FormulationChoice formulation_of(const Study& study);

}  // namespace flexneck::pipeline
