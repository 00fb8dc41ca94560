// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/average_derivative.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Geometry>

#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {

Eigen::MatrixXd averages_of(const RigidAverage& region, const Displacements& fields) {
  Eigen::MatrixXd motions(6, static_cast<Eigen::Index>(fields.size()));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    motions.col(static_cast<Eigen::Index>(k)) = region.of(*fields[k]);
  }
  return motions;
}

Eigen::MatrixXd average_derivative(const mesher::Mesh& mesh, const mesher::FaceSet& faces,
                                   const Eigen::Vector3d& point_m, const Eigen::Matrix3Xd& velocity,
                                   const Displacements& fields) {
  constexpr double kStep = 1e-3;  // fraction of the region's extent
  const mesher::NodeSet nodes = mesher::nodes_of(faces);
  const auto positions = mesher::positions_of(mesh);
  Eigen::AlignedBox3d region;
  double fastest = 0;
  for (const std::int32_t node : nodes.nodes) {
    region.extend(positions.col(node));
    fastest = std::max(fastest, velocity.col(node).norm());
  }
  const double extent = region.sizes().maxCoeff();
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(fields.size()));
  if (fastest == 0) return derivative;

  const double step = kStep * extent / fastest;
  mesher::Mesh moved;  // the average over given faces needs only the nodes
  moved.nodes = mesh.nodes;
  constexpr std::array<std::pair<double, double>, 4> kRule = {
      {{-2, 1.0 / 12}, {-1, -8.0 / 12}, {1, 8.0 / 12}, {2, -1.0 / 12}}};
  for (const auto& [steps, weight] : kRule) {
    for (const std::int32_t node : nodes.nodes) {
      for (std::size_t a = 0; a < 3; ++a) {
        const auto place = static_cast<std::size_t>(node);
        moved.nodes[place][a] =
            mesh.nodes[place][a] + steps * step * velocity(static_cast<Eigen::Index>(a), node);
      }
    }
    derivative += weight / step * averages_of(RigidAverage(moved, faces, point_m), fields);
  }
  return derivative;
}

}  // namespace flexneck::fe_modal
