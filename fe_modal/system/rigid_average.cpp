// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/rigid_average.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

/// Calls visit(nodes, shape_values, position, measure) for each quadrature point; measure is the
/// point's volume or area.
template <typename Visitor>
void for_each_point(const mesher::Mesh& mesh, mesher::ElementKind kind,
                    std::span<const std::int32_t> connectivity, const Visitor& visit) {
  const mesher::Quadrature rule = mesher::gauss_rule(kind, 3);
  const mesher::ShapeTable table = mesher::tabulate(kind, rule.points);
  const std::size_t width = mesher::nodes_per_element(kind);
  Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
  for (std::size_t first = 0; first < connectivity.size(); first += width) {
    const auto nodes = connectivity.subspan(first, width);
    mesher::copy_positions(mesh, nodes, coordinates);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      Eigen::Matrix3d jacobian;
      for (int b = 0; b < 3; ++b) {
        jacobian.col(b) = coordinates * table.derivatives[static_cast<std::size_t>(b)].col(q);
      }
      const double measure = mesher::dimension(kind) == 3
                                 ? jacobian.determinant()
                                 : jacobian.col(0).cross(jacobian.col(1)).norm();
      const Eigen::Vector3d position = coordinates * table.values.col(q);
      visit(nodes, table.values.col(q), position, measure * rule.weights[q]);
    }
  }
}

}  // namespace

RigidAverage::RigidAverage(const mesher::Mesh& mesh, const mesher::FaceSet& faces,
                           const Eigen::Vector3d& point_m)
    : point_(point_m) {
  std::vector<Region> regions;
  for (const mesher::FaceBlock& block : faces.blocks) regions.push_back({block.kind, block.nodes});
  average(mesh, regions, 1);
}

RigidAverage::RigidAverage(const mesher::Mesh& mesh, const std::string& part) {
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::vector<Region> regions;
  double density = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    if (block.part != part) continue;
    regions.push_back({block.kind, block.nodes});
    density = mesh.materials.at(block.material).density_kg_m3;
    for_each_point(mesh, block.kind, block.nodes,
                   [&](auto /*nodes*/, const auto& /*values*/, const Eigen::Vector3d& position,
                       double measure) {
                     volume += measure;
                     moment += measure * position;
                   });
  }
  point_ = moment / volume;
  average(mesh, regions, density);
}

void RigidAverage::average(const mesher::Mesh& mesh, const std::vector<Region>& regions,
                           double density) {
  for (const Region& region : regions) {
    nodes_.insert(nodes_.end(), region.connectivity.begin(), region.connectivity.end());
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  std::vector<Eigen::Index> column_of(mesh.nodes.size(), -1);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    column_of[static_cast<std::size_t>(nodes_[k])] = 3 * static_cast<Eigen::Index>(k);
  }
  map_.setZero(6, 3 * static_cast<Eigen::Index>(nodes_.size()));
  for (const Region& region : regions) {
    for_each_point(
        mesh, region.kind, region.connectivity,
        [&](auto nodes, const auto& values, const Eigen::Vector3d& position, double measure) {
          const Eigen::Matrix<double, 3, 6> field = rigid_motions_at(position - point_);
          gram_ += density * measure * field.transpose() * field;
          for (std::size_t i = 0; i < nodes.size(); ++i) {
            map_.middleCols<3>(column_of[static_cast<std::size_t>(nodes[i])]) +=
                density * measure * values[static_cast<Eigen::Index>(i)] * field.transpose();
          }
        });
  }
  map_ = gram_.llt().solve(map_).eval();
}

Vector6d RigidAverage::of(const Eigen::Matrix3Xd& field) const {
  Vector6d motion = Vector6d::Zero();
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    motion += map_.middleCols<3>(3 * static_cast<Eigen::Index>(k)) * field.col(nodes_[k]);
  }
  return motion;
}

std::array<Eigen::Matrix3Xd, 6> RigidAverage::weights(Eigen::Index node_count) const {
  std::array<Eigen::Matrix3Xd, 6> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].setZero(3, node_count);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      result[i].col(nodes_[k]) = map_.row(static_cast<Eigen::Index>(i))
                                     .segment<3>(3 * static_cast<Eigen::Index>(k))
                                     .transpose();
    }
  }
  return result;
}

}  // namespace flexneck::fe_modal
