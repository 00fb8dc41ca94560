// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/energy_gradient.h"

namespace flexneck::fe_modal {

/// Derivatives of f energy forms on a mesh of n nodes with m materials, and of its mass; see
/// EnergyGradient.
struct BodyGradient {
  std::vector<Eigen::Matrix3Xd> by_nodes;  ///< f matrices (3, n), J/m
  /// m matrices (f, 3): by Young's modulus, Poisson's ratio and density.
  std::vector<Eigen::MatrixX3d> by_material;
  Eigen::Matrix3Xd mass_by_nodes;  ///< (3, n), kg/m
  Eigen::VectorXd volumes_m3;      ///< (m): derivative of the mass by the density
};

/// @param fields displacement fields of the forms, (3, n) each
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
BodyGradient body_gradient(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const Displacements& fields, const std::vector<EnergyForm>& forms);

}  // namespace flexneck::fe_modal
