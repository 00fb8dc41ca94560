// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/point_forces.h"

#include <variant>

#include <Eigen/Geometry>

#include "fe_modal/dofs/point_element.h"

namespace flexneck::fe_modal {

Eigen::VectorXd weights_at_points(const mesher::Mesh& mesh, const DofMap& dof_map,
                                  const std::vector<Load>& loads) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_map.dof_count());
  for (const Load& load : loads) {
    const auto* const gravity = std::get_if<GravityLoad>(&load.kind);
    if (gravity == nullptr) continue;
    for (const mesher::PointMass& mass : mesh.connections.masses) {
      if (static_cast<std::size_t>(mass.site) < mesh.nodes.size()) continue;
      const Eigen::Vector3d weight_N = mass.mass_kg * gravity->acceleration_m_s2;
      dof_map.add_force(mass.site, weight_N, values);
      dof_map.add_force(mass.site + 1, Eigen::Vector3d(mass.center_m.data()).cross(weight_N),
                        values);
    }
  }
  return values;
}

Eigen::VectorXd spring_forces(const mesher::Mesh& mesh, const DofMap& dof_map,
                              const Eigen::VectorXd& free_values) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_map.dof_count());
  for (const PointElement& element : point_elements_of(mesh.connections, mesh.nodes.size())) {
    const auto n = static_cast<Eigen::Index>(element.sites.size());
    Eigen::MatrixX3d motions(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      motions.row(i) = dof_map.motion_of(element.sites[static_cast<std::size_t>(i)], free_values);
    }
    const Eigen::VectorXd forces = element.stiffness * motions.reshaped();
    for (Eigen::Index i = 0; i < n; ++i) {
      dof_map.add_force(element.sites[static_cast<std::size_t>(i)],
                        {forces[i], forces[n + i], forces[2 * n + i]}, values);
    }
  }
  return values;
}

}  // namespace flexneck::fe_modal
