// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/assembly.h"
#include "fe_modal/block_product.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {

TEST_CASE("many columns at once are multiplied as by the dense matrix") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 3}, {0.05, 0.05, 0.1}, {"metal", 2.1e11, 0.3, 7850}).make();
  const SystemMatrices system = assemble(mesh, FreeNodes(mesh, mesh.node_set("bottom").nodes));
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  for (const Eigen::Index count : {1, 8, 11}) {
    const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(stiffness.rows(), count);
    const Eigen::MatrixXd expected = stiffness * columns;
    // Sums of some hundred terms each.
    CHECK(block_product(system.stiffness, columns).isApprox(expected, 1e-13));
    CHECK(block_product(system.stiffness.get(), columns).isApprox(expected, 1e-13));
  }
}

}  // namespace flexneck::fe_modal
