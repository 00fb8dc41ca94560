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
/// @param field by its place among the fields
Stresses stresses_of(const PointFields& fields, double shear_modulus_Pa, Eigen::Index field);

/// An element of a mesh under a displacement field.
struct StressedElement {
  std::size_t block = 0;    ///< of the mesh
  std::size_t element = 0;  ///< of the block
  std::span<const std::int32_t> nodes;
  const ElementPoints& points;  ///< of the stiffness, (q)
  const Stresses& stress_Pa;    ///< (6, q), there
};

/// Calls `visit` for each element, block by block.
/// @param displacements_m of all nodes, (3, n)
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void for_each_stressed_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                               const Eigen::Matrix3Xd& displacements_m,
                               const std::function<void(const StressedElement&)>& visit);

/// int B^T sigma dV of all elements, (3, n) in N: K u, where the stresses are those of u.
Eigen::Matrix3Xd internal_forces(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                                 const Eigen::Matrix3Xd& displacements_m);

}  // namespace flexneck::fe_modal
