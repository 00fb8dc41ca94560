// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "multibody/numerics/lu_factors.h"
#include "tests/support/point_mass_body.h"

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("small systems of any scale of rows are solved with pivots of rows") {
  flexneck::testing::RandomNumbers random(71);
  for (const Index n : {1, 2, 7, 25, 60}) {
    MatrixXd A(n, n);
    random.fill(A);
    A.row(n / 2) *= 1e-9;
    A(0, 0) = 0;  // no pivot
    if (n == 1) A(0, 0) = -3;
    const VectorXd x = random.vector(n);
    flexneck::multibody::SmallLu factors(n);
    factors.matrix() = A;
    factors.factorise();
    VectorXd found = A * x;
    factors.solve(found);
    CAPTURE(n);
    CHECK((found - x).norm() < 1e-10 * x.norm());
  }
}
