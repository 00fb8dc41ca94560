// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/fe_modal/interface_compliance.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

/// Relative difference of two solutions of the same small problem in double precision.
constexpr double kSame = 1e-9;
const Eigen::Vector3d kTip(0.01, -0.02, 0.32);
const Eigen::Vector3d kRoot(0.02, 0.01, 0);

/// A rubber block without any symmetry.
mesher::Mesh block(std::array<int, 3> divisions = {1, 1, 2}) {
  testing::BlockMesh box = testing::box(divisions, {1, 1, 1}, {"rubber", 8.3e6, 0.49, 950});
  box.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.3 * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1));
  };
  return box.make();
}

ModalOptions fixed_with_rigid_tip(BasisKind basis, int count) {
  ModalOptions options;
  options.mode_count = count;
  options.basis = basis;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", kTip, true}};
  return options;
}

/// Basis of all motions of the free nodes that move those of a set rigidly: each degree of freedom
/// outside of the set, and six motions about the origin.
Eigen::MatrixXd motions_with_rigid(const mesher::Mesh& mesh, const DofMap& dof_map,
                                   const std::vector<std::int32_t>& nodes) {
  const Eigen::Index size = dof_map.dof_count();
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(size, 6);
  std::vector<bool> is_tied(static_cast<std::size_t>(size));
  for (const std::int32_t node : nodes) {
    const Eigen::Vector3d x =
        Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data());
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(dof_map.index(node));
    for (Eigen::Index a = 0; a < 3; ++a) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(a);
      rigid.block<3, 1>(row, a) = axis;
      rigid.block<3, 1>(row, 3 + a) = axis.cross(x);
      is_tied[static_cast<std::size_t>(row + a)] = true;
    }
  }
  Eigen::MatrixXd basis(size, size - 3 * static_cast<Eigen::Index>(nodes.size()) + 6);
  basis.leftCols<6>() = rigid;
  Eigen::Index column = 6;
  for (Eigen::Index k = 0; k < size; ++k) {
    if (!is_tied[static_cast<std::size_t>(k)]) basis.col(column++) = Eigen::VectorXd::Unit(size, k);
  }
  return basis;
}

struct Dense {
  Eigen::MatrixXd basis, stiffness, mass;
};

Dense dense_with_rigid_tip(const mesher::Mesh& mesh, const DofMap& dof_map) {
  const SystemMatrices system = assemble(mesh, dof_map);
  Dense model;
  model.basis = motions_with_rigid(mesh, dof_map, mesh.node_set("top").nodes);
  model.stiffness = model.basis.transpose() * dense(system.stiffness.get()) * model.basis;
  model.mass = model.basis.transpose() * dense(system.mass.get()) * model.basis;
  return model;
}

}  // namespace

TEST_CASE("with a rigid interface the modes are those of the constrained matrices") {
  const mesher::Mesh mesh = block();
  const ModalBody body = analyse_modes(mesh, fixed_with_rigid_tip(BasisKind::normal, 8), {});
  const Dense model = dense_with_rigid_tip(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const Eigen::VectorXd expected =
      testing::dense_pairs(model.stiffness, model.mass).values.head(8).cwiseSqrt() /
      (2 * std::numbers::pi);
  CHECK((body.frequencies_Hz.array() / expected.array() - 1).abs().maxCoeff() < kSame);
  CHECK(body.orthogonality < kSame);

  const Interface& tip = body.interface("tip");
  for (std::size_t l = 0; l < body.shapes.size(); ++l) {
    const auto column = static_cast<Eigen::Index>(l);
    for (const std::int32_t node : mesh.node_set("top").nodes) {
      const Eigen::Vector3d arm = body.nodes_m.col(node) - kTip;
      const Eigen::Vector3d moved =
          tip.translation.col(column) + Eigen::Vector3d(tip.rotation.col(column)).cross(arm);
      CHECK((body.shapes[l].col(node) - moved).norm() < kSame * body.shapes[l].norm());
    }
  }
}

TEST_CASE("a free body with a rigid interface has six rigid motions and the constrained modes") {
  const mesher::Mesh mesh = block({2, 2, 4});
  ModalOptions options;
  options.mode_count = 10;
  options.check = true;
  options.interfaces = {{"tip", "top", kTip, true}, {"root", "bottom", kRoot}};
  const ModalBody body = analyse_modes(mesh, options, {});
  const Dense model = dense_with_rigid_tip(mesh, DofMap(mesh, {}));
  const Eigen::VectorXd expected =
      testing::dense_pairs(model.stiffness, model.mass).values.segment(6, 4).cwiseSqrt() /
      (2 * std::numbers::pi);
  CHECK(body.frequencies_Hz.head(6).maxCoeff() == 0);
  CHECK((body.frequencies_Hz.tail(4).array() / expected.array() - 1).abs().maxCoeff() < kSame);
  // The Sturm count with the couplings agrees, and the finer mesh has the same modes.
  CHECK_THAT(body.completeness, Contains("checked: no mode is missing"));
  for (std::size_t l = 6; l < 10; ++l) {
    REQUIRE(body.modes[l].mesh_error);
    CHECK(body.modes[l].mesh_error->mac > 0.9);
  }
}

TEST_CASE("residual modes carry the compliance of a rigid interface") {
  const mesher::Mesh mesh = block();
  const ModalBody body = analyse_modes(mesh, fixed_with_rigid_tip(BasisKind::residual, 3), {});
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const Dense model = dense_with_rigid_tip(mesh, dof_map);
  const Eigen::MatrixXd motions = average_motion(mesh, "top", kTip, dof_map) * model.basis;
  const Eigen::MatrixXd expected =
      motions * testing::symmetric_solution(model.stiffness, motions.transpose());
  CHECK(difference(modal_compliance(body, "tip"), expected) < 1e-8);
}

TEST_CASE("rigid interfaces that cannot be are refused by name") {
  const mesher::Mesh mesh = block();
  ModalOptions options = fixed_with_rigid_tip(BasisKind::normal, 2);
  options.interfaces[0].set = "bottom";
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    "rigid interface 'tip' has nodes that are fixed");
  options = fixed_with_rigid_tip(BasisKind::normal, 2);
  options.interfaces.push_back({"again", "top", kTip, true});
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    Contains("rigid interface 'again' and rigid interface 'tip' contradict each "
                             "other: both determine x of the node at ("));
}

}  // namespace flexneck::fe_modal
