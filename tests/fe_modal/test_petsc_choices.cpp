// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/algebra/petsc_choices.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

ModalBody modes_with(const std::string& petsc_options, Solver solver = Solver::automatic) {
  ModalOptions options;
  options.mode_count = 4;
  options.fixed_set = "bottom";
  options.solver = solver;
  options.petsc_options = petsc_options;
  return analyse_modes(
      testing::box({2, 1, 4}, {0.05, 0.04, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make(), options, {});
}

}  // namespace

TEST_CASE("options of PETSc and SLEPc that are chosen hold, and change no result") {
  const Eigen::VectorXd plain_Hz = modes_with("").frequencies_Hz;
  for (const char* const chosen :
       {"-eps_ncv 30", "-eps_max_it 50 -st_ksp_type preonly", "-st_mat_cholmod_nmethods 1"}) {
    const Eigen::VectorXd found_Hz = modes_with(chosen).frequencies_Hz;
    CHECK((found_Hz - plain_Hz).cwiseAbs().maxCoeff() < 1e-9 * plain_Hz[0]);
  }
  const Eigen::VectorXd found_Hz =
      modes_with("-st_mat_mumps_icntl_14 60", Solver::mumps).frequencies_Hz;
  CHECK((found_Hz - plain_Hz).cwiseAbs().maxCoeff() < 1e-9 * plain_Hz[0]);
  // One restart is not enough for such a small space.
  CHECK_THROWS_AS(modes_with("-eps_ncv 5 -eps_max_it 1"), ComputationError);
}

TEST_CASE("options of PETSc that change what is solved, or that nothing asks for, are refused") {
  using Catch::Contains;
  CHECK_THROWS_WITH(modes_with("-st_shift 5"), Contains("-st_shift") && Contains("-eps_ncv"));
  CHECK_THROWS_WITH(modes_with("-eps_tol 1e-2"), Contains("-eps_tol"));
  CHECK_THROWS_WITH(modes_with("-st_pc_factor_shift_type nonzero"), Contains("shift_type"));
  CHECK_THROWS_WITH(modes_with("40"), Contains("found '40'"));
  CHECK_THROWS_WITH(modes_with("-st_mat_mumps_icntl_14 60"), Contains("without effect"));
  CHECK_THROWS_WITH(modes_with("-eps_ncvv 40"), Contains("without effect"));
}

TEST_CASE(
    "options by which something else is solved than the stiffness are not obeyed in silence") {
  // The solver applies half of K^-1, whose eigenvalues are twice those of K.
  CHECK_THROWS_WITH(modes_with("-st_ksp_type richardson -st_ksp_richardson_scale 0.5 "
                               "-st_ksp_norm_type none -st_ksp_max_it 1"),
                    Catch::Contains("change modes.petsc_options"));
  CHECK_THROWS_WITH(modes_with("-st_pc_factor_mat_solver_type mumps"),
                    Catch::Contains("choose the solver with modes.solver"));
}

}  // namespace flexneck::fe_modal
