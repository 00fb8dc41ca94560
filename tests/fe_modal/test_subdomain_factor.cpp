// SPDX-License-Identifier: GPL-3.0-or-later
#include <numeric>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/solve/iterative/subdomain_factor.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "mesher/partition/node_order.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

/// A block so soft beneath a stiff one that single precision has no factor.
SystemMatrices foam_below_steel() {
  testing::BlockMesh block = testing::box({1, 1, 1}, {0.05, 0.05, 0.1}, {});
  block.slices = {{"foam", 2, {"foam", 1e2, 0.3, 50}}, {"steel", 2, {"steel", 2.1e11, 0.3, 7850}}};
  const mesher::Mesh mesh = block.make();
  return assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
}

SystemMatrices clamped_column(double youngs_modulus_Pa) {
  const mesher::Mesh mesh =
      testing::box({2, 2, 5}, {0.05, 0.05, 0.1}, {"metal", youngs_modulus_Pa, 0.3, 7850}).make();
  return assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
}

SubdomainFactor factor_of(const SystemMatrices& system) {
  return {system.stiffness,
          mesher::nested_dissection(system.graph.offsets(), system.graph.columns())};
}

}  // namespace

TEST_CASE("a factor kept in single precision solves to its digits and adds where its nodes are") {
  const SystemMatrices system = clamped_column(20);
  const SubdomainFactor factor = factor_of(system);
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  // The subdomain is the second half of a field of twice its nodes.
  std::vector<std::int32_t> nodes(static_cast<std::size_t>(system.graph.node_count()));
  std::iota(nodes.begin(), nodes.end(), system.graph.node_count());
  const Eigen::Index size = stiffness.rows();
  const Eigen::MatrixXd truth = Eigen::MatrixXd::Random(size, 3);
  Eigen::MatrixXf residuals = Eigen::MatrixXf::Constant(2 * size, 3, 7);
  residuals.bottomRows(size) = (stiffness * truth).cast<float>();
  Eigen::MatrixXf result = Eigen::MatrixXf::Constant(2 * size, 3, 2);
  const std::vector<Eigen::Index> rows = factor.rows_of(nodes);
  result(rows, Eigen::all) += factor.solve(residuals(rows, Eigen::all));
  CHECK((result.topRows(size).array() == 2).all());
  // In the energy norm the error is the rounding of the factor times the root of the condition
  // number, 1e5: that is what a preconditioner is judged by.
  const auto energy = [&](const Eigen::VectorXd& x) { return std::sqrt(x.dot(stiffness * x)); };
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::VectorXd found = result.col(k).tail(size).cast<double>().array() - 2;
    CHECK(energy(found - truth.col(k)) < 1e-3 * energy(truth.col(k)));
  }
}

TEST_CASE("a subdomain whose pivots single precision loses has a factor all the same") {
  const SystemMatrices system = foam_below_steel();
  const SubdomainFactor factor = factor_of(system);
  std::vector<std::int32_t> nodes(static_cast<std::size_t>(system.graph.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  const std::vector<Eigen::Index> rows = factor.rows_of(nodes);
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  // A weight on the foam: by forces that do not move the steel in itself.
  const Eigen::VectorXd weight = dense(system.mass.get()) * Eigen::VectorXd::Ones(stiffness.rows());
  const Eigen::VectorXd expected = testing::symmetric_solution(stiffness, weight);
  const Eigen::MatrixXf given = weight(rows).cast<float>();
  const Eigen::VectorXd found = factor.solve(given).cast<double>();
  CHECK((found - expected(rows)).norm() < 1e-4 * expected.norm());
}

TEST_CASE("a subdomain that is not definite is refused") {
  CHECK_THROWS_AS(factor_of(clamped_column(-2.1e11)), ComputationError);
}

}  // namespace flexneck::fe_modal
