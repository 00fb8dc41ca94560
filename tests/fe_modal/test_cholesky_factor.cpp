// SPDX-License-Identifier: GPL-3.0-or-later
#include <numeric>
#include <set>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/system/assembly.h"
#include "mesher/partition/node_order.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

/// Entries of the factor when nodes of three degrees of freedom are eliminated in this order, by
/// playing the elimination: the neighbours that a node leaves behind become neighbours.
double fill(const NodeGraph& graph, const std::vector<std::int32_t>& order) {
  std::vector<std::size_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = k;
  std::vector<std::set<std::size_t>> later(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (const std::int32_t other : graph.neighbours(order[k])) {
      const std::size_t p = place[static_cast<std::size_t>(other)];
      if (p > k) later[k].insert(p);
    }
  }
  double entries = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    entries += 6 + 9 * static_cast<double>(later[k].size());
    if (later[k].empty()) continue;
    const std::size_t parent = *later[k].begin();
    later[parent].insert(std::next(later[k].begin()), later[k].end());
  }
  return entries;
}

}  // namespace

TEST_CASE("the factor is that of the order given, whichever it is") {
  const mesher::Mesh mesh = testing::box({3, 3, 8}, {0.1, 0.1, 0.3}, kSteel).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const std::vector<std::int32_t> dissection =
      mesher::nested_dissection(system.graph.offsets(), system.graph.columns());
  std::vector<std::int32_t> as_numbered(dissection.size());
  std::iota(as_numbered.begin(), as_numbered.end(), 0);
  // Every third node first: an order that nobody would choose by himself.
  std::vector<std::int32_t> scattered;
  for (std::int32_t start = 0; start < 3; ++start) {
    for (auto k = static_cast<std::size_t>(start); k < as_numbered.size(); k += 3) {
      scattered.push_back(as_numbered[k]);
    }
  }
  for (const auto& order : {dissection, as_numbered, scattered}) {
    const CholeskyFactor factor(system.stiffness.get(), 0, order);
    CHECK(factor.nonzeros() == fill(system.graph, order));
  }
  REQUIRE(fill(system.graph, scattered) > 1.3 * fill(system.graph, dissection));
  REQUIRE(fill(system.graph, as_numbered) != fill(system.graph, dissection));
  // Left to itself CHOLMOD finds something else again, and none of the bad ones.
  const CholeskyFactor own(system.stiffness.get(), 0);
  CHECK(own.nonzeros() != fill(system.graph, dissection));
  CHECK(own.nonzeros() < fill(system.graph, scattered));
}

TEST_CASE("solutions do not depend on the order of elimination") {
  const mesher::Mesh mesh = testing::box({2, 2, 3}, {0.1, 0.1, 0.3}, kSteel).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::VectorXd force = Eigen::VectorXd::Random(stiffness.rows());
  const Eigen::VectorXd expected = testing::symmetric_solution(stiffness, force);
  const auto order = mesher::nested_dissection(system.graph.offsets(), system.graph.columns());
  for (const auto& given : {order, std::vector<std::int32_t>()}) {
    const CholeskyFactor factor(system.stiffness.get(), 0, given);
    CHECK((factor.solve(force) - expected).norm() < 1e-9 * expected.norm());
  }
}

TEST_CASE(
    "subtrees of the elimination tree by several threads solve as one thread does, to the last "
    "bit") {
  const mesher::Mesh mesh = testing::box({5, 5, 24}, {0.1, 0.1, 0.5}, kSteel).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const auto order = mesher::nested_dissection(system.graph.offsets(), system.graph.columns());
  const CholeskyFactor alone(system.stiffness.get(), 0, order, 1);
  const CholeskyFactor together(system.stiffness.get(), 0, order, 3);
  REQUIRE(alone.nonzeros() > 1e6);  // enough for subtrees
  for (const Eigen::Index count : {1, 8, 11}) {
    const Eigen::MatrixXd truth = Eigen::MatrixXd::Random(3 * system.graph.node_count(), count);
    const Eigen::MatrixXd forces = SymmetricProduct(system.stiffness)(truth);
    const Eigen::MatrixXd solution = alone.solve(forces);
    CHECK((solution - truth).norm() < 1e-9 * truth.norm());
    CHECK(together.solve(forces) == solution);
  }
}

}  // namespace flexneck::fe_modal
