// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/analysis/body_gradient.h"
#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// Adds to a gradient the contribution of rigid couplings, which change the fields themselves:
/// where a node of a coupling moves with v, its displacement t + theta x (x - point) changes by
/// theta x v, and u^T A w by (A u) . (theta_w x v) + (A w) . (theta_u x v) with A = K - lambda M.
/// @param nodes those of the coupling
/// @param rotations theta of each field, (3, fields), rad
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void add_coupling_gradient(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const std::vector<std::int32_t>& nodes,
                           const Eigen::Matrix3Xd& rotations, const Displacements& fields,
                           const std::vector<EnergyForm>& forms, BodyGradient& gradient);

}  // namespace flexneck::fe_modal
