// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/linear_solver.h"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMaking = "creating the linear solver";
constexpr const char* kMeasuring = "estimating the size of the factor";
constexpr const char* kFactorising = "factorising the stiffness matrix";
constexpr const char* kSolving = "solving with the factor";
constexpr const char* kWayOut =
    "use a coarser mesh, or the solver mumps on several ranks or out of core (modes.petsc_options "
    "= \"-st_mat_mumps_icntl_22 1\")";

constexpr const char* kPrefix = "st_";  // prefix of options as for an EPS
/// Largest number of entries that CHOLMOD's integers of 32 bits can count.
constexpr double kMostEntries = std::numeric_limits<std::int32_t>::max();

/// Workspace of MUMPS beyond the estimate of its analysis, per cent: its default, and a second
/// attempt.
constexpr int kWorkspace = 20;
constexpr int kMoreWorkspace = 100;

// Values of INFOG(1) in the user's guide of MUMPS.
constexpr PetscInt kSingular = -10;
constexpr PetscInt kNoMemory = -13;
constexpr PetscInt kBeyondLimit = -19;  // limit that ICNTL(23) sets
constexpr PetscInt kNotDefinite = -40;

bool wants_more_workspace(PetscInt status) {
  return status == -8 || status == -9 || status == -14 || status == -15 || status == -17 ||
         status == -20;
}

[[noreturn]] void throw_not_definite() {
  throw NotDefinite("the stiffness matrix is not positive definite");
}

[[noreturn]] void throw_too_large() {
  throw InputError(
      "the factor of the stiffness matrix has more than the 2147483647 entries that CHOLMOD "
      "supports; use the solver mumps");
}

Solver chosen(Solver solver, const Ranks& ranks) {
  if (solver == Solver::automatic) return ranks.are_many() ? Solver::mumps : Solver::cholmod;
  if (solver == Solver::cholmod && ranks.are_many())
    throw InputError("the solver cholmod runs on one process only; use mumps on several ranks");
  return solver;
}

}  // namespace

LinearSolver::LinearSolver(Mat shifted_stiffness, double shift, const Ranks& ranks, Solver solver)
    : shift_(shift), ranks_(ranks), solver_(chosen(solver, ranks)) {
  require(PetscObjectReference(reinterpret_cast<PetscObject>(shifted_stiffness)), kMaking);
  *matrix_.out() = shifted_stiffness;
  set_up(kWorkspace);
  check_memory();
  factorise();
  MatInfo info{};
  require(MatGetInfo(factor(), MAT_GLOBAL_SUM, &info), kFactorising);
  // MUMPS reports millions, with a negative sign, if the number of entries exceeds the range of an
  // integer.
  constexpr PetscInt kEntries = 9;
  const PetscInt entries = solver_ == Solver::mumps ? infog(factor(), kEntries) : 0;
  nonzeros_ =
      solver_ == Solver::cholmod ? info.nz_used : (entries < 0 ? -1e6 * entries : double(entries));
}

void LinearSolver::set_up(int mumps_workspace_percent) {
  require(KSPCreate(communicator(ranks_), ksp_.out()), kMaking);
  KSP ksp = ksp_.get();
  require(KSPSetOptionsPrefix(ksp, kPrefix), kMaking);
  require(KSPSetOperators(ksp, matrix(), matrix()), kMaking);
  require(KSPSetType(ksp, KSPPREONLY), kMaking);
  PC preconditioner = nullptr;
  require(KSPGetPC(ksp, &preconditioner), kMaking);
  require(PCSetType(preconditioner, PCCHOLESKY), kMaking);
  const bool is_mumps = solver_ == Solver::mumps;
  require(PCFactorSetMatSolverType(preconditioner, is_mumps ? MATSOLVERMUMPS : MATSOLVERCHOLMOD),
          kMaking);
  require(PCFactorSetMatOrderingType(preconditioner,
                                     is_mumps ? MATORDERINGEXTERNAL : MATORDERINGNATURAL),
          kMaking);
  require(KSPSetFromOptions(ksp), kMaking);
  require(PCFactorSetUpMatSolverType(preconditioner), kMaking);
  if (is_mumps && mumps_workspace_percent != kWorkspace)
    require(MatMumpsSetIcntl(factor(), 14, mumps_workspace_percent), kMaking);
}

Mat LinearSolver::factor() const {
  PC preconditioner = nullptr;
  Mat factor = nullptr;
  require(KSPGetPC(ksp_.get(), &preconditioner), kMaking);
  require(PCFactorGetMatrix(preconditioner, &factor), kMaking);
  return factor;
}

/// Estimates the memory of the numeric factorisation by a symbolic one alone. PETSc's PC does both
/// at once; therefore a trial factor is made here, which is discarded at the end.
void LinearSolver::check_memory() const {
  MatHandle trial;
  IsHandle rows;
  IsHandle columns;
  MatFactorInfo how{};
  const bool is_mumps = solver_ == Solver::mumps;
  require(MatGetFactor(matrix(), is_mumps ? MATSOLVERMUMPS : MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY,
                       trial.out()),
          kMeasuring);
  require(MatSetOptionsPrefix(trial.get(), kPrefix), kMeasuring);
  require(MatFactorInfoInitialize(&how), kMeasuring);
  if (!is_mumps)
    require(MatGetOrdering(matrix(), MATORDERINGNATURAL, rows.out(), columns.out()), kMeasuring);
  const PetscErrorCode code = MatCholeskyFactorSymbolic(trial.get(), matrix(), rows.get(), &how);
  constexpr const char* kTooLarge = "status -3";  // CHOLMOD_TOO_LARGE, as PETSc reports it
  if (!is_mumps && code == PETSC_ERR_LIB &&
      last_petsc_message().find(kTooLarge) != std::string::npos)
    throw_too_large();
  require(code, kMeasuring);
  if (is_mumps) {
    constexpr PetscInt kIsOutOfCore = 22;
    constexpr PetscInt kMegabytesInCore = 16;  // maximum over the ranks
    constexpr PetscInt kMegabytesOutOfCore = 26;
    constexpr double kMegabyte = 1e6;
    PetscInt is_out_of_core = 0;
    require(MatMumpsGetIcntl(trial.get(), kIsOutOfCore, &is_out_of_core), kMeasuring);
    const PetscInt megabytes =
        infog(trial.get(), is_out_of_core != 0 ? kMegabytesOutOfCore : kMegabytesInCore);
    return require_memory(kFactorising, kMegabyte * megabytes * ranks_.on_this_machine(), kWayOut);
  }
  MatInfo info{};
  require(MatGetInfo(trial.get(), MAT_LOCAL, &info), kMeasuring);
  if (info.nz_used > kMostEntries) throw_too_large();
  require_memory(kFactorising, sizeof(double) * info.nz_used, kWayOut);
}

bool LinearSolver::iterates() const {
  KSPType type = nullptr;
  require(KSPGetType(ksp_.get(), &type), kMaking);
  return std::string_view(type) != KSPPREONLY && std::string_view(type) != KSPNONE;
}

void LinearSolver::factorise() {
  const auto set_up_code = [&] { return KSPSetUp(ksp_.get()); };
  PetscErrorCode code = set_up_code();
  if (solver_ == Solver::mumps && code == 0 && wants_more_workspace(infog(factor(), 1))) {
    set_up(kMoreWorkspace);
    code = set_up_code();
  }
  if (code == PETSC_ERR_MAT_CH_ZRPVT) throw_not_definite();
  require(code, kFactorising);
  if (solver_ != Solver::mumps) return;
  const PetscInt status = infog(factor(), 1);
  constexpr PetscInt kNegativePivots = 12;
  if (status == kNotDefinite || status == kSingular || infog(factor(), kNegativePivots) > 0)
    throw_not_definite();
  if (status >= 0) return;
  if (status == kNoMemory || status == kBeyondLimit || wants_more_workspace(status))
    throw OutOfMemory("factorising the stiffness matrix: not enough memory for MUMPS; " +
                      std::string(kWayOut));
  throw ComputationError(
      "MUMPS failed while factorising the stiffness matrix: INFOG(1) = " + std::to_string(status) +
      ", INFOG(2) = " + std::to_string(infog(factor(), 2)) +
      "; use modes.solver = \"cholmod\" in one process");
}

Eigen::MatrixXd LinearSolver::solve(const Eigen::MatrixXd& right_hand_sides) const {
  Eigen::MatrixXd solutions(right_hand_sides.rows(), right_hand_sides.cols());
  if (right_hand_sides.cols() == 0) return solutions;
  const MatHandle in = dense_on(right_hand_sides, ranks_);
  const MatHandle out = dense_on(solutions, ranks_);
  require(KSPMatSolve(ksp_.get(), in.get(), out.get()), kSolving);
  ++block_solves_;
  return solutions;
}

std::unique_ptr<LinearSolver> shift_inverse(const ModalSystem& system, double shift) {
  const MatHandle shifted =
      shift == 0 ? MatHandle() : shifted_stiffness(system.stiffness(), system.mass(), shift);
  return std::make_unique<LinearSolver>(shift == 0 ? system.stiffness() : shifted.get(), shift,
                                        system.ranks(), system.solver());
}

std::string LinearSolver::describe() const {
  constexpr double kMillion = 1e6;
  PetscInt solves = 0;
  require(KSPGetTotalIterations(ksp_.get(), &solves), kSolving);
  const std::string on =
      ranks_.are_many() ? " on " + std::to_string(ranks_.count()) + " ranks" : "";
  return (solver_ == Solver::mumps ? "MUMPS" : "CHOLMOD") + on + ": the factor has " +
         rounded_text(nonzeros_ / kMillion, 4) + " million entries; " + std::to_string(solves) +
         " solves, " + std::to_string(block_solves_) + " of blocks";
}

}  // namespace flexneck::fe_modal
