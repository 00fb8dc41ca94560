// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/prestress.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/kept_exception.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kBuckling = "solving for the buckling load";
/// Of the largest eigenvalue, 1 / factor.
constexpr double kTolerance = 1e-9;
constexpr PetscInt kBasis = 24;
constexpr PetscInt kRestarts = 200;
/// A body that buckles only above this factor, if ever, is not said to: the eigenvalues 1 / factor
/// of a body in tension come as near to zero as the mesh allows, and no iteration tells them apart.
constexpr double kLargestFactor = 1000;
/// By then the largest eigenvalue is known to some digits.
constexpr PetscInt kSettled = 4;

struct Inverse {
  const ShiftInverse* inverse;
  KeptException failure;
};

PetscErrorCode apply_inverse(PC preconditioner, Vec x, Vec y) {
  Inverse* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, static_cast<void*>(&context));
  if (code != 0) return code;
  return context->failure.keep([&] { solve(*context->inverse, x, y); });
}

/// Converged is also what has settled too near to zero.
PetscErrorCode relative_error(EPS eps, PetscScalar value, PetscScalar /*imaginary*/,
                              PetscReal residual, PetscReal* error, void* /*context*/) {
  PetscInt iterations = 0;
  const PetscErrorCode code = EPSGetIterationNumber(eps, &iterations);
  if (code != 0) return code;
  const bool is_none = iterations >= kSettled && value * kLargestFactor < 1;
  *error =
      is_none ? 0 : residual * kLargestFactor / std::max(1.0, std::abs(value) * kLargestFactor);
  return 0;
}

/// Largest eigenvalue of -K_g x = theta K x, by Krylov-Schur in the inner product of K.
double largest_eigenvalue(Mat compression, Mat stiffness, Inverse& inverse) {
  EpsHandle handle;
  require(EPSCreate(PETSC_COMM_SELF, handle.out()), kBuckling);
  EPS eps = handle.get();
  require(EPSSetOperators(eps, compression, stiffness), kBuckling);
  require(EPSSetProblemType(eps, EPS_GHEP), kBuckling);
  require(EPSSetType(eps, EPSKRYLOVSCHUR), kBuckling);
  require(EPSSetWhichEigenpairs(eps, EPS_LARGEST_REAL), kBuckling);
  PetscInt size = 0;
  require(MatGetSize(stiffness, &size, nullptr), kBuckling);
  require(EPSSetDimensions(eps, 1, std::min(size, kBasis), PETSC_DEFAULT), kBuckling);
  require(EPSSetTolerances(eps, kTolerance, kRestarts), kBuckling);
  require(EPSSetConvergenceTestFunction(eps, relative_error, nullptr, nullptr), kBuckling);
  ST transform = nullptr;
  require(EPSGetST(eps, &transform), kBuckling);
  require(STSetType(transform, STSHIFT), kBuckling);
  require(STSetMatMode(transform, ST_MATMODE_SHELL), kBuckling);
  KSP solver = nullptr;
  require(STGetKSP(transform, &solver), kBuckling);
  require(KSPSetType(solver, KSPPREONLY), kBuckling);
  PC preconditioner = nullptr;
  require(KSPGetPC(solver, &preconditioner), kBuckling);
  require(PCSetType(preconditioner, PCSHELL), kBuckling);
  require(PCShellSetContext(preconditioner, &inverse), kBuckling);
  require(PCShellSetApply(preconditioner, apply_inverse), kBuckling);
  const PetscErrorCode code = EPSSolve(eps);
  inverse.failure.rethrow();
  rethrow_from(compression);
  rethrow_from(stiffness);
  require(code, kBuckling);
  PetscInt converged = 0;
  require(EPSGetConverged(eps, &converged), kBuckling);
  if (converged < 1) throw ComputationError("the search for the buckling load does not converge");
  double value = 0;
  require(EPSGetEigenvalue(eps, 0, &value, nullptr), kBuckling);
  return value;
}

/// Each rank solves the static problem by itself: all need its displacements.
ModalOptions alone(ModalOptions options) {
  options.ranks = {};
  options.element_ranks.clear();
  return options;
}

ModalOptions without_prestress(ModalOptions options) {
  options.prestress_m.resize(3, 0);
  return options;
}

[[noreturn]] void refuse_buckled(double factor) {
  throw InputError("the body buckles under its prestress, at " + rounded_text(factor, 4) +
                   " of the loads: modes are those of a body that does not; lessen them");
}

}  // namespace

ModalOptions with_prestress(const mesher::Mesh& mesh, ModalOptions options,
                            const Progress& progress) {
  if (options.prestress.empty()) return options;
  options = without_prestress(std::move(options));
  options.prestress_m =
      static_step(mesh, alone(options), options.prestress, progress).displacements_m;
  return options;
}

std::string large_prestress_text(const mesher::Mesh& mesh, const ModalOptions& options) {
  if (options.prestress_m.cols() == 0) return {};
  constexpr double kLargestStrain = 0.1;
  constexpr double kLargestTurn_rad = 0.3;
  double strain = 0;
  double turn_rad = 0;
  for_each_element(
      mesh, options.formulation, {&options.prestress_m}, [&](const ElementState& state) {
        for (Eigen::Index q = 0; q < state.fields.volumes_m3.size(); ++q) {
          Eigen::Matrix3d gradient;
          for (Eigen::Index k = 0; k < 9; ++k)
            gradient(k / 3, k % 3) = state.fields.gradients[static_cast<std::size_t>(k)](0, q);
          const Eigen::Matrix3d half_skew = (gradient - gradient.transpose()) / 2;
          turn_rad = std::max(turn_rad, half_skew.norm() / std::numbers::sqrt2);
          if (gradient.norm() <= strain) continue;
          const Eigen::Vector3d strains =
              Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>((gradient + gradient.transpose()) / 2,
                                                             Eigen::EigenvaluesOnly)
                  .eigenvalues();
          strain = std::max(strain, strains.cwiseAbs().maxCoeff());
        }
      });
  if (strain <= kLargestStrain && turn_rad <= kLargestTurn_rad) return {};
  return "the static step of the prestress strains the body by up to " + rounded_text(strain, 2) +
         " and turns parts of it by up to " + rounded_text(turn_rad * 180 / std::numbers::pi, 2) +
         " deg: theory of small displacements errs by a tenth and more above a strain of 0.1 or "
         "some 20 deg; lessen the loads";
}

std::optional<double> buckling_factor(const mesher::Mesh& mesh, const DofMap& dof_map,
                                      const ModalOptions& options) {
  const SymmetricMatrix geometric =
      assemble_geometric(mesh, dof_map, options.formulation, options.prestress_m);
  const AssembledSystem system(mesh, dof_map, alone(without_prestress(options)));
  const std::unique_ptr<const ShiftInverse> factor = system.shift_inverse(0);
  Inverse inverse{factor.get(), {}};
  const SymmetricProduct product(geometric);
  const OperatorMatrix compression(dof_map.dof_count(), [&](const Eigen::MatrixXd& columns) {
    return Eigen::MatrixXd(-product(columns));
  });
  const double value = largest_eigenvalue(compression.get(), system.stiffness(), inverse);
  if (!(value * kLargestFactor > 1)) return std::nullopt;
  return 1 / value;
}

std::unique_ptr<const ShiftInverse> factorise_prestressed(const mesher::Mesh& mesh,
                                                          const DofMap& dof_map,
                                                          const AssembledSystem& system,
                                                          const ModalOptions& options) {
  const auto refuse_if_buckled = [&] {
    const std::optional<double> factor = buckling_factor(mesh, dof_map, options);
    if (factor && *factor <= 1) refuse_buckled(*factor);
  };
  // An iteration does not tell whether the matrix is definite.
  if (options.solver == Solver::iterative) refuse_if_buckled();
  try {
    return system.shift_inverse(0);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {
    refuse_if_buckled();
    throw;
  }
}

std::string prestress_text(const ModalOptions& options) {
  std::string text;
  for (const Load& load : options.prestress) text += (text.empty() ? "" : "; ") + describe(load);
  return text;
}

}  // namespace flexneck::fe_modal
