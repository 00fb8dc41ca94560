// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <Eigen/Core>

#include "fe_modal/body/stress.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Stresses of one displacement field at an element's q points, (6, q).
/// @param field index among the fields
Stresses stresses_of(const PointFields& fields, double shear_modulus_Pa, Eigen::Index field);

/// An element of a mesh under a displacement field.
struct StressedElement {
  std::size_t block = 0;    ///< index of the block in the mesh
  std::size_t element = 0;  ///< index of the element in the block
  std::span<const std::int32_t> nodes;
  const ElementPoints& points;  ///< points of the stiffness, (q)
  const Stresses& stress_Pa;    ///< (6, q), at the points
};

/// Calls `visit` for each element, block by block.
/// @param displacements_m displacements of all nodes, (3, n)
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void for_each_stressed_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                               const Eigen::Matrix3Xd& displacements_m,
                               const std::function<void(const StressedElement&)>& visit);

/// Internal forces int B^T sigma dV of all elements, (3, n) in N: K u for the stresses of u.
Eigen::Matrix3Xd internal_forces(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                                 const Eigen::Matrix3Xd& displacements_m);

}  // namespace flexneck::fe_modal
