// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/corner_fields.h"

#include <algorithm>
#include <array>
#include <span>

#include <Eigen/LU>

#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;

/// Jacobian dx_a / dxi_b at point q of a table.
Eigen::Matrix3d jacobian(const mesher::ShapeTable& table, Eigen::Index q,
                         const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3d result;
  for (int b = 0; b < 3; ++b) {
    result.col(b) = positions * table.derivatives[static_cast<std::size_t>(b)].col(q);
  }
  return result;
}

/// Calls visit(element's nodes) for each element of a block.
template <typename Visit>
void for_each_element(const mesher::ElementBlock& block, Visit&& visit) {
  const std::size_t width = mesher::nodes_per_element(block.kind);
  for (std::size_t first = 0; first < block.nodes.size(); first += width) {
    visit(std::span(block.nodes).subspan(first, width));
  }
}

/// Integrals over an element of the shape functions of its corners.
class CornerVolumes {
 public:
  explicit CornerVolumes(ElementKind kind)
      : rule_(mesher::gauss_rule(kind, 3)),
        table_(mesher::tabulate(kind, rule_.points)),
        functions_(
            mesher::tabulate(mesher::linear_kind_of(mesher::shape_of(kind)), rule_.points).values) {
  }

  /// Integrals for the positions of an element's nodes, (c), m^3.
  Eigen::VectorXd of(const Eigen::Matrix3Xd& positions) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(functions_.rows());
    for (Eigen::Index q = 0; q < rule_.weights.size(); ++q) {
      result += rule_.weights[q] * jacobian(table_, q, positions).determinant() * functions_.col(q);
    }
    return result;
  }

 private:
  mesher::Quadrature rule_;
  mesher::ShapeTable table_;
  Eigen::MatrixXd functions_;  ///< (c, q)
};

/// Half the curl of a displacement with the gradient g, du_a / dx_b.
Eigen::Vector3d half_curl(const Eigen::Matrix3d& g) {
  return 0.5 * Eigen::Vector3d(g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1));
}

Eigen::Matrix3Xd reference_corners(ElementKind kind) {
  const auto nodes = mesher::reference_nodes(kind).first(mesher::corners_per_element(kind));
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(nodes.size()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    points.col(k) = Eigen::Map<const Eigen::Vector3d>(nodes[static_cast<std::size_t>(k)].data());
  }
  return points;
}

Eigen::Matrix3Xd columns_of(const Eigen::Matrix3Xd& field, std::span<const std::int32_t> nodes) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(nodes.size()));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    result.col(k) = field.col(nodes[static_cast<std::size_t>(k)]);
  }
  return result;
}

}  // namespace

CornerMasses lump_at_corners(const mesher::Mesh& mesh) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const CornerVolumes volumes(block.kind);
    const double density = mesh.materials[block.material].density_kg_m3;
    for_each_element(block, [&](std::span<const std::int32_t> nodes) {
      const Eigen::VectorXd shares = density * volumes.of(mesher::positions_of(mesh, nodes));
      for (Eigen::Index k = 0; k < shares.size(); ++k) {
        masses[nodes[static_cast<std::size_t>(k)]] += shares[k];
      }
    });
  }
  CornerMasses result;
  for (Eigen::Index node = 0; node < masses.size(); ++node) {
    if (masses[node] > 0) result.nodes.push_back(static_cast<std::int32_t>(node));
  }
  result.masses_kg = masses(result.nodes);
  return result;
}

Eigen::Matrix3Xd corner_rotations(const mesher::Mesh& mesh,
                                  const std::vector<std::int32_t>& corners,
                                  const Eigen::Matrix3Xd& displacements) {
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, displacements.cols());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(displacements.cols());
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const CornerVolumes volumes(block.kind);
    const mesher::ShapeTable table = mesher::tabulate(block.kind, reference_corners(block.kind));
    const double modulus = mesh.materials[block.material].youngs_modulus_Pa;
    for_each_element(block, [&](std::span<const std::int32_t> nodes) {
      const Eigen::Matrix3Xd positions = mesher::positions_of(mesh, nodes);
      const Eigen::Matrix3Xd motion = columns_of(displacements, nodes);
      const double weight = modulus * volumes.of(positions).sum();
      for (Eigen::Index k = 0; k < table.values.cols(); ++k) {
        const std::int32_t node = nodes[static_cast<std::size_t>(k)];
        sums.col(node) += weight * half_curl(jacobian(table, k, motion) *
                                             jacobian(table, k, positions).inverse());
        weights[node] += weight;
      }
    });
  }
  Eigen::Matrix3Xd result = columns_of(sums, corners);
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    result.col(k) /= weights[corners[static_cast<std::size_t>(k)]];
  }
  return result;
}

}  // namespace flexneck::fe_modal
