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

/// An element of a mesh under displacement fields.
struct ElementState {
  std::size_t block = 0;    ///< index of the block in the mesh
  std::size_t element = 0;  ///< index of the element in the block
  std::span<const std::int32_t> nodes;
  const Eigen::Matrix3Xd& nodes_m;  ///< positions of the nodes
  const PointFields& fields;        ///< gradients and stresses of the displacements
  double shear_modulus_Pa = 0;
  ElementKernel& kernel;
};

/// Calls `visit` for each element, block by block.
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void for_each_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const Displacements& displacements,
                      const std::function<void(const ElementState&)>& visit);

}  // namespace flexneck::fe_modal
