// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/nodal_stresses.h"

#include <string>

#include <Eigen/QR>

#include "fe_modal/element/stressed_elements.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

Eigen::Matrix3Xd reference_positions(mesher::ElementKind kind) {
  const auto nodes = mesher::reference_nodes(kind);
  return Eigen::Map<const Eigen::Matrix3Xd>(nodes.front().data(), 3,
                                            static_cast<Eigen::Index>(nodes.size()));
}

/// Sums of stresses at the nodes of one material, and the number of elements in each sum.
struct NodalSums {
  Stresses sums_Pa;        ///< (6, n)
  Eigen::VectorXd counts;  ///< (n)
};

NodalStresses averaged(const std::string& material, const NodalSums& sums) {
  NodalStresses result{material, {}, {}};
  for (Eigen::Index k = 0; k < sums.counts.size(); ++k) {
    if (sums.counts[k] > 0) result.nodes.push_back(static_cast<std::int32_t>(k));
  }
  result.stress_Pa.resize(6, static_cast<Eigen::Index>(result.nodes.size()));
  for (Eigen::Index k = 0; k < result.stress_Pa.cols(); ++k) {
    const std::int32_t node = result.nodes[static_cast<std::size_t>(k)];
    result.stress_Pa.col(k) = sums.sums_Pa.col(node) / sums.counts[node];
  }
  return result;
}

}  // namespace

Eigen::MatrixXd extrapolation_to_nodes(const ElementScheme& scheme) {
  const mesher::ElementKind corners = mesher::linear_kind_of(mesher::shape_of(scheme.kind));
  const auto values_at = [&](const Eigen::Matrix3Xd& points) -> Eigen::MatrixXd {
    return mesher::tabulate(corners, points).values.transpose();
  };
  const Eigen::MatrixXd at_points =
      values_at(mesher::gauss_rule(scheme.kind, scheme.strength).points);
  // The pseudoinverse has the smallest coefficients if there are fewer points than corners; those
  // of constants are then all equal.
  const Eigen::MatrixXd coefficients =
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(at_points).pseudoInverse();
  return values_at(reference_positions(scheme.kind)) * coefficients;
}

StressFields stress_fields(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const Eigen::Matrix3Xd& displacements_m) {
  const Eigen::Index n = displacements_m.cols();
  std::vector<NodalSums> sums(mesh.materials.size(),
                              {Stresses::Zero(6, n), Eigen::VectorXd::Zero(n)});
  StressFields result;
  Eigen::MatrixXd extrapolation;
  for_each_stressed_element(
      mesh, formulation, displacements_m, [&](const StressedElement& element) {
        const mesher::ElementBlock& block = mesh.blocks[element.block];
        const Eigen::Index q = element.stress_Pa.cols();
        if (element.element == 0) {
          const auto points = static_cast<Eigen::Index>(block.size()) * q;
          result.at_points.push_back({block.part, std::string(name_of(block.kind)),
                                      static_cast<int>(q), Eigen::Matrix3Xd(3, points),
                                      Stresses(6, points)});
          extrapolation = extrapolation_to_nodes(
              element_scheme(block.kind, formulation.of(mesh.materials.at(block.material))));
        }
        const auto first = static_cast<Eigen::Index>(element.element) * q;
        result.at_points.back().positions_m.middleCols(first, q) = element.points.positions_m;
        result.at_points.back().stress_Pa.middleCols(first, q) = element.stress_Pa;
        NodalSums& of_material = sums.at(block.material);
        const Stresses at_nodes = element.stress_Pa * extrapolation.transpose();
        for (Eigen::Index i = 0; i < at_nodes.cols(); ++i) {
          const std::int32_t node = element.nodes[static_cast<std::size_t>(i)];
          of_material.sums_Pa.col(node) += at_nodes.col(i);
          of_material.counts[node] += 1;
        }
      });
  for (std::size_t m = 0; m < sums.size(); ++m) {
    NodalStresses each = averaged(mesh.materials[m].name, sums[m]);
    if (!each.nodes.empty()) result.at_nodes.push_back(std::move(each));
  }
  return result;
}

}  // namespace flexneck::fe_modal
