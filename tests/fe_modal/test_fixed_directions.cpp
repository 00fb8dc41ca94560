// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>
#include <vector>

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
const Eigen::Vector3d kTip(0.01, -0.02, 0.3);

mesher::Mesh block() {
  return testing::box({2, 2, 4}, {0.12, 0.15, 0.3}, {"rubber", 8.3e6, 0.45, 950}).make();
}

/// Options of a block on rollers that rotate about x, leaning on a wall that it may slide along.
ModalOptions on_rollers(BasisKind basis, int count) {
  ModalOptions options;
  options.mode_count = count;
  options.basis = basis;
  options.fixed_directions = {{"bottom", {false, true, true}}, {"left", {true, false, false}}};
  options.interfaces = {{"tip", "top", kTip}};
  return options;
}

/// Block with its side x = 0 as a set, which boxes do not name.
mesher::Mesh block_with_left() {
  mesher::Mesh mesh = block();
  mesher::NodeSet left{"left", {}};
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    if (std::abs(mesh.nodes[k][0]) < 1e-9) left.nodes.push_back(static_cast<std::int32_t>(k));
  }
  REQUIRE(!left.nodes.empty());
  std::erase_if(mesh.node_sets, [](const mesher::NodeSet& set) { return set.name == "left"; });
  mesh.node_sets.push_back(std::move(left));
  return mesh;
}

/// Indices of a free body's degrees of freedom that remain free under the options.
std::vector<Eigen::Index> free_directions(const mesher::Mesh& mesh, const ModalOptions& options) {
  const DofMap all(mesh, {});
  std::vector<bool> is_fixed(static_cast<std::size_t>(all.dof_count()));
  for (const auto& [set, directions] : options.fixed_directions) {
    for (const std::int32_t node : mesh.node_set(set).nodes) {
      for (std::size_t a = 0; a < 3; ++a) {
        if (directions[a]) is_fixed[3 * static_cast<std::size_t>(all.index(node)) + a] = true;
      }
    }
  }
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < is_fixed.size(); ++k) {
    if (!is_fixed[k]) free.push_back(static_cast<Eigen::Index>(k));
  }
  return free;
}

Eigen::MatrixXd rows_and_columns(Mat matrix, const std::vector<Eigen::Index>& kept) {
  return dense(matrix)(kept, kept);
}

}  // namespace

TEST_CASE("with fixed directions the modes are those of the matrices without them") {
  const mesher::Mesh mesh = block_with_left();
  ModalOptions options = on_rollers(BasisKind::normal, 6);
  options.check = true;
  const ModalBody body = analyse_modes(mesh, options, {});
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const std::vector<Eigen::Index> kept = free_directions(mesh, options);
  const Eigen::VectorXd expected =
      testing::dense_pairs(rows_and_columns(system.stiffness.get(), kept),
                           rows_and_columns(system.mass.get(), kept))
          .values.head(6)
          .cwiseSqrt() /
      (2 * std::numbers::pi);
  CHECK((body.frequencies_Hz.array() / expected.array() - 1).abs().maxCoeff() < kSame);
  CHECK(body.orthogonality < kSame);
  CHECK(body.boundary == "fixed: yz of bottom, x of left");
  CHECK_THAT(body.completeness, Contains("checked: no mode is missing"));
  for (std::size_t l = 0; l < body.shapes.size(); ++l) {
    CHECK(body.modes[l].residual < kSame);
    REQUIRE(body.modes[l].mesh_error);
    CHECK(body.modes[l].mesh_error->mac > 0.9);
    for (const std::int32_t node : mesh.node_set("bottom").nodes) {
      CHECK(body.shapes[l].col(node).tail<2>().isZero(0));
    }
    for (const std::int32_t node : mesh.node_set("left").nodes) {
      CHECK(body.shapes[l](0, node) == 0);
    }
  }
}

TEST_CASE("residual modes carry the compliance of a body with fixed directions") {
  const mesher::Mesh mesh = block_with_left();
  const ModalOptions options = on_rollers(BasisKind::residual, 3);
  const ModalBody body = analyse_modes(mesh, options, {});
  const DofMap all(mesh, {});
  const SystemMatrices system = assemble(mesh, all);
  const std::vector<Eigen::Index> kept = free_directions(mesh, options);
  const Eigen::MatrixXd motions = average_motion(mesh, "top", kTip, all)(Eigen::all, kept);
  const Eigen::MatrixXd expected =
      motions * testing::symmetric_solution(rows_and_columns(system.stiffness.get(), kept),
                                            motions.transpose());
  CHECK(difference(modal_compliance(body, "tip"), expected) < 1e-8);
}

TEST_CASE(
    "a rigid motion that directions leave has frequency zero, and the modes are those above") {
  const mesher::Mesh mesh = block();
  ModalOptions options = on_rollers(BasisKind::normal, 6);
  options.fixed_directions = {{"bottom", {false, true, true}}};
  options.check = true;
  const ModalBody body = analyse_modes(mesh, options, {});
  CHECK(body.boundary == "fixed: yz of bottom; slides along x");
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const std::vector<Eigen::Index> kept = free_directions(mesh, options);
  const Eigen::VectorXd expected =
      testing::dense_pairs(rows_and_columns(system.stiffness.get(), kept),
                           rows_and_columns(system.mass.get(), kept))
          .values.segment(1, 5)
          .cwiseSqrt() /
      (2 * std::numbers::pi);
  CHECK(body.frequencies_Hz[0] == 0);
  CHECK(body.modes[0].kind == kRigidMode);
  CHECK((body.frequencies_Hz.tail(5).array() / expected.array() - 1).abs().maxCoeff() < kSame);
  CHECK_THAT(body.completeness, Contains("checked: no mode is missing"));
  options.basis = BasisKind::residual;
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    Contains("this is a body that slides along x; use 'inertia-relief'"));
}

TEST_CASE("fixed directions that cannot be are refused") {
  const mesher::Mesh mesh = block_with_left();
  ModalOptions options = on_rollers(BasisKind::normal, 6);
  options.fixed_directions["nowhere"] = {true, false, false};
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}), Contains("nowhere"));
  options = on_rollers(BasisKind::normal, 6);
  options.interfaces = {{"tip", "bottom", kTip, true}};
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    "rigid interface 'tip' has nodes that are fixed");
}

}  // namespace flexneck::fe_modal
