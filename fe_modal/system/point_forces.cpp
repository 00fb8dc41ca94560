// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/point_forces.h"

#include <algorithm>
#include <set>
#include <variant>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "fe_modal/body/skew.h"
#include "fe_modal/dofs/point_element.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {

namespace {

/// Calls visit(mass, weight in N) for each mass at a reference point under each load of gravity.
template <typename Visitor>
void for_each_weight(const mesher::Mesh& mesh, const std::vector<Load>& loads,
                     const Visitor& visit) {
  for (const Load& load : loads) {
    const auto* const gravity = std::get_if<GravityLoad>(&load.kind);
    if (gravity == nullptr) continue;
    for (const mesher::PointMass& mass : mesh.connections.masses) {
      if (static_cast<std::size_t>(mass.site) < mesh.nodes.size()) continue;
      visit(mass, Eigen::Vector3d(mass.mass_kg * gravity->acceleration_m_s2));
    }
  }
}

/// Sites that each connection joins: nodes, and reference points, which are numbered behind the
/// nodes.
std::vector<std::set<std::int32_t>> joined(const mesher::Connections& connections,
                                           std::int32_t node_count) {
  std::vector<std::set<std::int32_t>> groups;
  const auto number = [&](std::int32_t site) {
    return site < node_count ? site : node_count + (site - node_count) / 2;
  };
  const auto add_terms = [&](const auto& each) {
    std::set<std::int32_t>& group = groups.emplace_back();
    for (const mesher::Term& term : each.terms) group.insert(number(term.site));
  };
  for (const mesher::Coupling& coupling : connections.couplings) {
    groups.emplace_back(coupling.nodes.begin(), coupling.nodes.end())
        .insert(node_count + coupling.point);
  }
  for (const mesher::Equation& equation : connections.equations) add_terms(equation);
  for (const mesher::Spring& spring : connections.springs) add_terms(spring);
  return groups;
}

/// Nodes nearest to a point: those joined to it, or else to points that are joined to it, and so
/// on.
std::vector<std::int32_t> nodes_near(std::int32_t point, std::int32_t node_count,
                                     const std::vector<std::set<std::int32_t>>& groups) {
  std::set<std::int32_t> reached = {point};
  for (std::size_t before = 0; reached.size() > before && *reached.begin() >= node_count;) {
    before = reached.size();
    std::set<std::int32_t> more;
    for (const std::set<std::int32_t>& group : groups) {
      const auto is_reached = [&](std::int32_t each) { return reached.contains(each); };
      if (std::any_of(group.begin(), group.end(), is_reached))
        more.insert(group.begin(), group.end());
    }
    reached.merge(more);
  }
  return {reached.begin(), reached.lower_bound(node_count)};
}

}  // namespace

Eigen::VectorXd weights_at_points(const mesher::Mesh& mesh, const DofMap& dof_map,
                                  const std::vector<Load>& loads) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_map.dof_count());
  for_each_weight(mesh, loads, [&](const mesher::PointMass& mass, const Eigen::Vector3d& weight_N) {
    dof_map.add_force(mass.site, weight_N, values);
    dof_map.add_force(mass.site + 1, Eigen::Vector3d(mass.center_m.data()).cross(weight_N), values);
  });
  return values;
}

Eigen::Matrix3Xd weights_on_nodes(const mesher::Mesh& mesh, const mesher::Connections& connections,
                                  const std::vector<Load>& loads) {
  const auto node_count = static_cast<std::int32_t>(mesh.nodes.size());
  const auto groups = joined(connections, node_count);
  const double length_m = mesher::bounding_box(mesh).extent_m().norm();
  const auto nodes_m = mesher::positions_of(mesh);
  Eigen::Matrix3Xd forces_N = Eigen::Matrix3Xd::Zero(3, node_count);
  for_each_weight(mesh, loads, [&](const mesher::PointMass& mass, const Eigen::Vector3d& weight_N) {
    const std::int32_t point = (mass.site - node_count) / 2;
    const std::vector<std::int32_t> nodes = nodes_near(node_count + point, node_count, groups);
    const Eigen::Vector3d center_m =
        Eigen::Vector3d(connections.points[static_cast<std::size_t>(point)].position_m.data()) +
        Eigen::Vector3d(mass.center_m.data());
    // Columns are motions of the nodes as one body about the centre of mass, where the weight has
    // no moment.
    Eigen::MatrixXd motions(3 * static_cast<Eigen::Index>(nodes.size()), 6);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      motions.middleRows<3>(3 * static_cast<Eigen::Index>(k)) =
          rigid_motions_at((nodes_m.col(nodes[k]) - center_m) / length_m);
    }
    Eigen::Matrix<double, 6, 1> resultant = Eigen::Matrix<double, 6, 1>::Zero();
    resultant.head<3>() = weight_N;
    const Eigen::VectorXd shares =
        motions.transpose().completeOrthogonalDecomposition().solve(resultant);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      forces_N.col(nodes[k]) += shares.segment<3>(3 * static_cast<Eigen::Index>(k));
    }
  });
  return forces_N;
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
