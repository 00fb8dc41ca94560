// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/reduction/operators.h"
#include "fe_modal/reduction/particles.h"
#include "fe_modal/reduction/reduction.h"
#include "fe_modal/solve/assembled_system.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Geometric stiffness int grad(psi_i)^T sigma grad(psi_j) dV = int sum_a psi_i,a,k sigma_kl
/// psi_j,a,l dV for each of several stress fields.
/// @param modes m fields on all nodes, (3, n)
/// @param displacements fields on all nodes, (3, n), that cause the stresses
/// @return (m, m) for each displacement field
std::vector<Eigen::MatrixXd> geometric_stiffness(
    const mesher::Mesh& mesh, const FormulationChoice& formulation,
    const std::vector<Eigen::Matrix3Xd>& modes, const std::vector<Eigen::Matrix3Xd>& displacements);

/// Geometric stiffness for the stresses of unit accelerations, angular accelerations, products of
/// angular velocities, modal accelerations and interface loads of a fixed body, from static
/// solutions.
/// @param particles point masses of the body, with their motions in the modes
GeometricStiffness unit_load_stiffness(const mesher::Mesh& mesh,
                                       const FormulationChoice& formulation,
                                       const AssembledSystem& system, const BodyOperators& body,
                                       const std::vector<InterfaceLoads>& interfaces,
                                       const std::vector<Eigen::Matrix3Xd>& modes,
                                       const std::vector<Particle>& particles);

}  // namespace flexneck::fe_modal
