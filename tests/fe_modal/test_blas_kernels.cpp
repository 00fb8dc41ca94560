// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/petsc_session.h"

using namespace flexneck::fe_modal;
using Catch::Matchers::Contains;

TEST_CASE("a session takes kernels that use the processor's vector units, whichever its model") {
  const PetscSession session;
  Eigen::MatrixXd product(200, 300);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(200, 150);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(150, 300);
  multiply(1, a, b, 0, product);
  CHECK((product - Eigen::MatrixXd(a.lazyProduct(b))).cwiseAbs().maxCoeff() < 1e-12);
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") == 0 || std::getenv("OPENBLAS_CORETYPE") != nullptr) return;
  CHECK_THAT(blas_version(), !Contains("Prescott") && !Contains("Barcelona"));
#endif
}
