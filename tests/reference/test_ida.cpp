// SPDX-License-Identifier: GPL-3.0-or-later
// SUNDIALS IDA, an independent variable-order BDF method, on a flexible model whose equations are
// formulated a third time, in the modal coordinates alone.
#include <ida/ida.h>
#include <memory>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <catch2/catch.hpp>

#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/minimal_neck.h"
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

/// Residual for y = [a; a']: F = [a' - y_2; M a'' - f].
int residual(double time_s, N_Vector y, N_Vector rate, N_Vector result, void* user) {
  const Eigen::Index m = N_VGetLength(y) / 2;
  const auto terms =
      static_cast<const MinimalModel*>(user)->terms(time_s, values(y).head(m), values(y).tail(m));
  values(result).head(m) = values(rate).head(m) - values(y).tail(m);
  values(result).tail(m) = terms.mass * values(rate).tail(m) - terms.load;
  return 0;
}

/// Modal coordinates at `end_s` by IDA, starting at rest.
VectorXd by_ida(MinimalModel model, double end_s) {
  const Eigen::Index m = model.neck.mode_count();
  const sundials::Context context;
  const VectorHandle y(N_VNew_Serial(2 * m, context));
  const VectorHandle rate(N_VNew_Serial(2 * m, context));
  values(y.get()).setZero();
  values(rate.get()).setZero();
  const VectorXd none = VectorXd::Zero(m);
  values(rate.get()).tail(m) = model.accelerations(0, none, none);
  const IdaHandle ida(IDACreate(context));
  REQUIRE(IDAInit(ida.get(), residual, 0, y.get(), rate.get()) == IDA_SUCCESS);
  REQUIRE(IDASStolerances(ida.get(), 1e-10, 1e-12) == IDA_SUCCESS);
  REQUIRE(IDASetUserData(ida.get(), &model) == IDA_SUCCESS);
  REQUIRE(IDASetMaxNumSteps(ida.get(), 100000) == IDA_SUCCESS);
  REQUIRE(IDASetStopTime(ida.get(), end_s) == IDA_SUCCESS);
  const MatrixHandle matrix(SUNDenseMatrix(2 * m, 2 * m, context));
  const SolverHandle solver(SUNLinSol_Dense(y.get(), matrix.get(), context));
  REQUIRE(IDASetLinearSolver(ida.get(), solver.get(), matrix.get()) == IDA_SUCCESS);
  double reached_s = 0;
  REQUIRE(IDASolve(ida.get(), end_s, &reached_s, y.get(), rate.get(), IDA_NORMAL) >= 0);
  REQUIRE(reached_s == end_s);
  return values(y.get()).head(m);
}

}  // namespace

TEST_CASE("SUNDIALS IDA takes a braked flexible neck with its head to the same place") {
  const TimeTable brake({0, 0.06}, {-100, -220}, TimeTable::Outside::constant);
  const Pose pose = hanging_pose();
  const Vector3d direction = Vector3d(2, 1, 0).normalized();
  ModelBuilder build = head_on_neck({direction, 4, brake}, pose, Beam{}, 0.3, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  constexpr double kEnd_s = 0.06;
  const History own =
      simulate(build.model, solver_of(1e-11, 1e-13), {.end_time_s = kEnd_s, .interval_s = kEnd_s});
  const VectorXd other = by_ida({make_beam_body(Beam{}), 0.3, make_head(),
                                 pose.rotation.conjugate() * build.model.gravity_m_s2,
                                 pose.rotation.conjugate() * direction, brake},
                                kEnd_s);
  const VectorXd found = own.modal[0].coordinates.col(1);
  CHECK(found.norm() > 1e-2);
  // The BDF run has some thousand steps at 1e-10 each.
  CHECK((other - found).norm() < 1e-7 * found.norm());
}
