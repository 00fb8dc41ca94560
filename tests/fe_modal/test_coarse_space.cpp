// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/solve/iterative/coarse_space.h"
#include "fe_modal/solve/iterative/interface_pieces.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/rank_part.h"
#include "mesher/mesh/positions.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

/// Two by two elements, each a subdomain.
struct FourSubdomains {
  mesher::Mesh mesh =
      testing::box({2, 2, 1}, {0.05, 0.05, 0.03}, {"rubber", 1e6, 0.4995, 1100}).make();
  DofMap dof_map{mesh, {}};
  FieldMap fields{dof_map};
  Subdomains subdomains;
  Eigen::MatrixXd rigid = rigid_motions(mesh, dof_map);

  FourSubdomains() {
    const std::vector<std::int32_t>& all = mesh.blocks.front().nodes;
    for (auto first = all.begin(); first != all.end(); first += 27) {
      subdomains.of_element.push_back(subdomains.count());
      subdomains.blocks.emplace_back(first, first + 27);
      std::sort(subdomains.blocks.back().begin(), subdomains.blocks.back().end());
    }
  }
};

}  // namespace

TEST_CASE("the interface of four subdomains around a line is four faces and the line") {
  const FourSubdomains body;
  const InterfacePieces pieces = interface_pieces(body.mesh, body.dof_map, body.subdomains);
  const Eigen::Matrix3Xd positions_m = mesher::positions_of(body.mesh);
  REQUIRE(pieces.blocks.size() == 5);
  for (const std::vector<std::int32_t>& nodes : pieces.blocks) {
    const Eigen::MatrixXd motions = rigid_motions_of(nodes, body.rigid);
    // Of the nodes on a line one rotation moves none.
    CHECK((nodes.size() == 3 ? motions.cols() == 5 : nodes.size() == 6 && motions.cols() == 6));
    CHECK((motions.transpose() * motions).isIdentity(1e-12));
    const Eigen::Vector3d axis(0.3, -1.2, 0.7);
    Eigen::VectorXd rotation(motions.rows());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      rotation.segment<3>(static_cast<Eigen::Index>(3 * k)) =
          axis.cross(positions_m.col(nodes[k]).eval());
    }
    CHECK((motions * (motions.transpose() * rotation)).isApprox(rotation, 1e-12));
  }
}

TEST_CASE("the coarse correction is a projection onto fields without force inside of subdomains") {
  const FourSubdomains body;
  SystemMatrices system = assemble(body.mesh, body.dof_map);
  const SymmetricMatrix shifted = shifted_stiffness(system, -1e5);
  const Eigen::MatrixXd matrix = dense(shifted.get());
  const RankPart all(body.mesh, body.dof_map);
  const CoarseSpace coarse({body.mesh, body.fields, body.subdomains, {0, 0, 0, 0}},
                           {shifted, system.graph, all.blocks()});
  CHECK(coarse.size() == 4 * 6 + 5);
  const auto corrected = [&](const Eigen::MatrixXd& loads) {
    Eigen::MatrixXf result = Eigen::MatrixXf::Zero(loads.rows(), loads.cols());
    coarse.add_correction(loads.cast<float>(), result);
    return Eigen::MatrixXd(result.cast<double>());
  };
  // The functions are kept in single precision; what is nearly incompressible magnifies that.
  constexpr double kDigits = 1e-6;
  constexpr double kRounding = 1e-4;
  const Eigen::MatrixXd field = corrected(Eigen::MatrixXd::Random(matrix.rows(), 40));
  CHECK(field.jacobiSvd().setThreshold(kRounding).rank() == coarse.size());
  const Eigen::MatrixXd forces = matrix * field;
  const Eigen::MatrixXd summands = matrix.cwiseAbs() * field.cwiseAbs();
  CHECK(corrected(forces).isApprox(field, kRounding));
  const InterfacePieces pieces = interface_pieces(body.mesh, body.dof_map, body.subdomains);
  for (std::size_t node = 0; node < pieces.piece_of.size(); ++node) {
    if (pieces.piece_of[node] >= 0) continue;
    const auto rows = static_cast<Eigen::Index>(3 * node);
    CHECK(forces.middleRows<3>(rows).norm() < kDigits * summands.middleRows<3>(rows).norm());
  }
}

}  // namespace flexneck::fe_modal
