// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// A mass that moves rigidly with a site. Particles of a rigid body at a reference point have its
/// mass, first and second moments of mass; some of their masses are negative.
struct Particle {
  double mass_kg = 0;
  std::int32_t site = 0;  ///< a node, or the translation of a reference point
  Eigen::Vector3d arm_m = Eigen::Vector3d::Zero();  ///< arm from the site, about which it rotates
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd motions;  ///< (3, m) motion in each mode
};

/// Particles of the mesh's point masses, with their motions in the modes, (dofs, m).
std::vector<Particle> particles_of(const mesher::Mesh& mesh, const DofMap& dof_map,
                                   const Eigen::MatrixXd& modes);

}  // namespace flexneck::fe_modal
