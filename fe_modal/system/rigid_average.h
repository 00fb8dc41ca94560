// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

using Vector6d = Eigen::Matrix<double, 6, 1>;  ///< translation (3), then rotation (3)
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The rigid motion that fits a displacement field on a region best in the least-squares sense: [t;
/// theta] minimises int |u - t - theta x (x - point)|^2 dw, with dw the area of faces or the mass
/// of elements.
class RigidAverage {
 public:
  /// Area-weighted average over the faces, about the given point.
  RigidAverage(const mesher::Mesh& mesh, const mesher::FaceSet& faces,
               const Eigen::Vector3d& point_m);
  /// Mass-weighted average over all elements of a part, about their centre of mass.
  /// @pre the mesh has a part of that name
  RigidAverage(const mesher::Mesh& mesh, const std::string& part);

  /// Average motion of a field.
  /// @param field displacements of all nodes, (3, n)
  Vector6d of(const Eigen::Matrix3Xd& field) const;

  /// The six weight vectors as nodal fields, (3, n) each: of(u)[i] is the sum over all entries of
  /// weights(n)[i] times u.
  std::array<Eigen::Matrix3Xd, 6> weights(Eigen::Index node_count) const;

  const Eigen::Vector3d& point_m() const { return point_; }
  /// Integral int R^T R dw with R = [I, -~(x - point)]: for elements the rigid mass matrix about
  /// the centre of mass, kg, kg m, kg m^2.
  const Matrix6d& gram() const { return gram_; }

 private:
  /// Elements or faces of one kind.
  struct Region {
    mesher::ElementKind kind;
    std::span<const std::int32_t> connectivity;
  };

  void average(const mesher::Mesh& mesh, const std::vector<Region>& regions, double density);

  Eigen::Vector3d point_;
  Matrix6d gram_ = Matrix6d::Zero();
  std::vector<std::int32_t> nodes_;               ///< nodes of the region, ascending
  Eigen::Matrix<double, 6, Eigen::Dynamic> map_;  ///< (6, 3 nodes_.size())
};

}  // namespace flexneck::fe_modal
