// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <unsupported/Eigen/KroneckerProduct>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {

TEST_CASE("many columns at once are multiplied as by the dense matrix") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 3}, {0.05, 0.05, 0.1}, {"metal", 2.1e11, 0.3, 7850}).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const NodalMass& nodal_mass = system.mass.between_nodes();
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::MatrixXd mass =
      Eigen::kroneckerProduct(Eigen::MatrixXd(nodal_mass), Eigen::Matrix3d::Identity());
  // One, all together, and some that are left over and go by themselves or not.
  for (const Eigen::Index count : {1, 8, 10, 19}) {
    const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(stiffness.rows(), count);
    // Sums of some hundred terms each.
    const Eigen::MatrixXd forces = stiffness * columns;
    CHECK(SymmetricProduct(system.stiffness)(columns).isApprox(forces, 1e-13));
    CHECK(block_product(system.stiffness.get(), columns).isApprox(forces, 1e-13));
    const Eigen::MatrixXd momenta = mass * columns;
    CHECK(block_product(nodal_mass, columns).isApprox(momenta, 1e-13));
    CHECK(block_product(system.mass.get(), columns).isApprox(momenta, 1e-13));
  }
}

TEST_CASE("what bends costs little force, and little of that is rounding") {
  // Entries of K x cancel to 1e-6 of them: by rows in double precision 1e-11 of the rest is left.
  constexpr double kLength = 1;
  const mesher::Mesh mesh =
      testing::box({1, 1, 40}, {0.01, 0.01, kLength}, {"metal", 2.1e11, 0.3, 7850}).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  Eigen::Matrix3Xd bent(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const Eigen::Vector3d position(mesh.nodes[k].data());
    const double z = position.z() / kLength;
    bent.col(static_cast<Eigen::Index>(k)) << 1 - std::cos(z), 0, -position.x() * std::sin(z);
  }
  const Eigen::VectorXd x = dof_map.gather(bent);
  using Extended = long double;
  const auto extended = [](const Eigen::MatrixXd& values) {
    return values.cast<Extended>().eval();
  };
  const Eigen::VectorXd exact =
      (extended(dense(system.stiffness.get())) * extended(x)).cast<double>();
  const double by_rows = (dense(system.stiffness.get()) * x - exact).norm();
  const double found = (SymmetricProduct(system.stiffness)(x) - exact).norm();
  CHECK(found < by_rows / 10);
  CHECK(found < 1e-13 * exact.norm());
}

TEST_CASE("an operator serves PETSc by single vectors and us by blocks, and its failure is told") {
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(6, 6);
  Eigen::Index widest = 0;
  const OperatorMatrix shell(6, [&](const Eigen::MatrixXd& columns) {
    widest = std::max(widest, columns.cols());
    return Eigen::MatrixXd(matrix * columns);
  });
  CHECK(dense(shell.get()).isApprox(matrix, 1e-14));
  CHECK(widest == 1);
  CHECK(block_product(shell.get(), matrix).isApprox(matrix * matrix, 1e-14));
  CHECK(widest == 6);

  const OperatorMatrix broken(6, [](const Eigen::MatrixXd&) -> Eigen::MatrixXd {
    throw ComputationError("no rank answers");
  });
  CHECK_THROWS_AS(dense(broken.get()), ComputationError);
}

}  // namespace flexneck::fe_modal
