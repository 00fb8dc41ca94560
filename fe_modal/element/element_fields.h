// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Displacements of all nodes, (3, n) each.
using Displacements = std::vector<const Eigen::Matrix3Xd*>;

/// Values of all fields at an element's nodes.
/// @param values is filled, (3 n, fields): degree of freedom a n + i is direction a of node i
void gather(std::span<const std::int32_t> nodes, const Displacements& fields,
            Eigen::MatrixXd& values);

/// Calls `visit` with the gradients and stresses of the displacements in each element and with its
/// shear modulus, in Pa.
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void for_each_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const Displacements& displacements,
                      const std::function<void(const PointFields&, double)>& visit);

}  // namespace flexneck::fe_modal
