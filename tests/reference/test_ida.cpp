// SPDX-License-Identifier: GPL-3.0-or-later
// SUNDIALS IDA, variable-order BDF of other people's making, on a flexible model.
#include <ida/ida.h>
#include <memory>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <catch2/catch.hpp>

#include "multibody/equations.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};
using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix>;
using SolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver>;
using IdaHandle = std::unique_ptr<void, FreeIda>;

Eigen::Map<VectorXd> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}

/// F = y' - f(t, y).
int residual(double time_s, N_Vector y, N_Vector rate, N_Vector result, void* user) {
  const VectorXd state = values(y);
  VectorXd expected(state.size());
  static_cast<Equations*>(user)->derivative(time_s, state, expected);
  values(result) = values(rate) - expected;
  return 0;
}

/// The state at `end_s` by IDA.
VectorXd by_ida(Equations& equations, double end_s) {
  equations.set_interval(0, end_s);
  const VectorXd start = equations.given_state();
  const sundials::Context context;
  const VectorHandle y(N_VNew_Serial(start.size(), context));
  const VectorHandle rate(N_VNew_Serial(start.size(), context));
  values(y.get()) = start;
  VectorXd first(start.size());
  equations.derivative(0, start, first);
  values(rate.get()) = first;
  const IdaHandle ida(IDACreate(context));
  REQUIRE(IDAInit(ida.get(), residual, 0, y.get(), rate.get()) == IDA_SUCCESS);
  REQUIRE(IDASStolerances(ida.get(), 1e-11, 1e-12) == IDA_SUCCESS);
  REQUIRE(IDASetUserData(ida.get(), &equations) == IDA_SUCCESS);
  REQUIRE(IDASetMaxNumSteps(ida.get(), 100000) == IDA_SUCCESS);
  REQUIRE(IDASetStopTime(ida.get(), end_s) == IDA_SUCCESS);
  const MatrixHandle matrix(SUNDenseMatrix(start.size(), start.size(), context));
  const SolverHandle solver(SUNLinSol_Dense(y.get(), matrix.get(), context));
  REQUIRE(IDASetLinearSolver(ida.get(), solver.get(), matrix.get()) == IDA_SUCCESS);
  double reached_s = 0;
  REQUIRE(IDASolve(ida.get(), end_s, &reached_s, y.get(), rate.get(), IDA_NORMAL) >= 0);
  REQUIRE(reached_s == end_s);
  return values(y.get());
}

}  // namespace

TEST_CASE("SUNDIALS IDA takes a braked flexible neck with its head to the same place") {
  const Formulation formulation = either_formulation();
  const TimeTable brake({0, 0.06}, {-100, -220}, TimeTable::Outside::constant);
  ModelBuilder build = head_on_neck({Vector3d(2, 1, 0).normalized(), 4, brake}, hanging_pose(),
                                    Beam{}, 0.3, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  SolverOptions solver{.relative_tolerance = 1e-11, .absolute_tolerance = 1e-13};
  solver.formulation = formulation;
  constexpr double kEnd_s = 0.06;
  const History own = simulate(build.model, solver, {.end_time_s = kEnd_s, .interval_s = kEnd_s});
  const auto equations = formulation == Formulation::recursive
                             ? recursive_equations(build.model, solver)
                             : descriptor_equations(build.model, solver);
  const VectorXd other = by_ida(*equations, kEnd_s);
  // The neck's modes follow its seven positions in the descriptor form, and come first in the
  // other.
  const auto modes = other.segment(formulation == Formulation::recursive ? 0 : 7, 4);
  const VectorXd found = own.modal[0].coordinates.col(1);
  CHECK(found.norm() > 1e-2);
  // A BDF run of some thousand steps at 1e-11 each.
  CHECK((modes - found).norm() < 1e-7 * found.norm());
}
