// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/eigensolver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/kept_exception.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/random_block.h"
#include "fe_modal/solve/block_lanczos.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving for the modes";

/// Residuals relative to the eigenvalue theta = 1 / (lambda - shift). The error of an eigenvector
/// is this over the relative gap to its neighbour: 1e-10 for frequencies 1 % apart.
constexpr double kResidual = 1e-12;
constexpr PetscInt kMoreThanTwice = 10;  ///< basis vectors beyond twice the wanted pairs
/// The first pair that is not wanted is settled to the square of this: enough to tell that it is
/// not one that was missed.
constexpr double kResidualOfNext = 1e-2;
constexpr Eigen::Index kColumns = 8;  ///< a free body has six equal eigenvalues
constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kSeedOfOthers = 2;

struct Problem {
  Mat stiffness;
  Mat mass;
  const ShiftInverse* inverse;
};

/// What SLEPc gets for (K - shift M)^-1.
struct InverseContext {
  const ShiftInverse* inverse;
  KeptException failure;
};

/// What SLEPc calls for y = (K - shift M)^-1 x.
PetscErrorCode apply_inverse(PC preconditioner, Vec x, Vec y) {
  InverseContext* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, static_cast<void*>(&context));
  if (code != 0) return code;
  return context->failure.keep([&] { solve(*context->inverse, x, y); });
}

/// @param context lives as long as the solver
EpsHandle make_solver(const Problem& problem, InverseContext& context) {
  EpsHandle handle;
  require(EPSCreate(communicator(problem.inverse->ranks()), handle.out()), kSolving);
  EPS eps = handle.get();
  require(EPSSetOperators(eps, problem.stiffness, problem.mass), kSolving);
  require(EPSSetProblemType(eps, EPS_GHEP), kSolving);
  require(EPSSetType(eps, EPSKRYLOVSCHUR), kSolving);
  require(EPSSetTarget(eps, problem.inverse->shift()), kSolving);
  require(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE), kSolving);
  ST transform = nullptr;
  require(EPSGetST(eps, &transform), kSolving);
  require(STSetType(transform, STSINVERT), kSolving);
  // SLEPc would factorise anew for each search: the factor that we have takes its place.
  require(STSetMatMode(transform, ST_MATMODE_SHELL), kSolving);
  KSP solver = nullptr;
  require(STGetKSP(transform, &solver), kSolving);
  require(KSPSetType(solver, KSPPREONLY), kSolving);
  PC inverse = nullptr;
  require(KSPGetPC(solver, &inverse), kSolving);
  require(PCSetType(inverse, PCSHELL), kSolving);
  require(PCShellSetContext(inverse, &context), kSolving);
  require(PCShellSetApply(inverse, apply_inverse), kSolving);
  return handle;
}

EigenPairs converged_pairs(EPS eps, const Problem& problem, Eigen::Index count, Eigen::Index size) {
  const Ranks& ranks = problem.inverse->ranks();
  EigenPairs pairs{Eigen::VectorXd(count), Eigen::MatrixXd(size, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const VecHandle vector = column_vector(pairs.vectors, k, ranks);
    require(EPSGetEigenpair(eps, static_cast<PetscInt>(k), &pairs.values[k], nullptr, vector.get(),
                            nullptr),
            kSolving);
  }
  const Eigen::VectorXd squares =
      column_products(ranks, pairs.vectors, block_product(problem.mass, pairs.vectors));
  pairs.vectors *= squares.cwiseSqrt().cwiseInverse().asDiagonal();
  return pairs;
}

/// The lowest pairs, but of a multiple eigenvalue perhaps only one.
EigenPairs search(const Problem& problem, Eigen::Index count, const Eigen::MatrixXd& start) {
  InverseContext inverse{problem.inverse, {}};
  const EpsHandle handle = make_solver(problem, inverse);
  EPS eps = handle.get();
  const VecHandle start_handle = column_vector(start, 0, problem.inverse->ranks());
  Vec start_space = start_handle.get();
  require(EPSSetInitialSpace(eps, 1, &start_space), kSolving);
  const auto wanted = static_cast<PetscInt>(count);
  PetscInt size = 0;
  require(MatGetSize(problem.mass, &size, nullptr), kSolving);
  require(EPSSetDimensions(eps, wanted, std::min(size, 2 * wanted + kMoreThanTwice), PETSC_DEFAULT),
          kSolving);
  require(EPSSetTolerances(eps, kResidual, 200), kSolving);
  require(EPSSetPurify(eps, PETSC_FALSE), kSolving);  // done below, all at once
  const PetscErrorCode code = EPSSolve(eps);
  inverse.failure.rethrow();
  rethrow_from(problem.stiffness);
  rethrow_from(problem.mass);
  require(code, kSolving);
  PetscInt converged = 0;
  require(EPSGetConverged(eps, &converged), kSolving);
  if (converged < wanted) {
    throw ComputationError("the eigensolver found " + std::to_string(converged) + " of " +
                           std::to_string(wanted) + " modes");
  }
  return converged_pairs(eps, problem, count, start.rows());
}

/// The pairs with the copies of multiple eigenvalues that a Krylov space of one vector, which has
/// only its own part of each eigenspace, has missed.
EigenPairs completed(const Problem& problem, const EigenPairs& pairs) {
  const Eigen::Index count = pairs.values.size();
  const Eigen::Index size = size_of(problem.mass);
  if (count == size) return pairs;
  const Settled settled = [&](const RitzState& state) {
    return state.residuals.head(count).maxCoeff() < kResidual &&
           state.residuals[count] < kResidualOfNext;
  };
  const Eigen::Index columns = std::min(kColumns, size - count);
  const EigenPairs all =
      block_lanczos(problem.mass, *problem.inverse, pairs,
                    random_block(problem.mass, columns, kSeedOfOthers), count + 1, settled);
  EigenPairs found{all.values.head(count), all.vectors.leftCols(count)};
  if (all.values.size() > count) found.next = all.values[count];
  return found;
}

}  // namespace

EigenPairs lowest_eigenpairs(Mat stiffness, Mat mass, const ShiftInverse& inverse,
                             Eigen::Index count, const Eigen::VectorXd& start) {
  if (std::optional<EigenPairs> own = inverse.iterate(mass, count)) return *std::move(own);
  const Problem problem{stiffness, mass, &inverse};
  Eigen::MatrixXd first = random_block(mass, 1, kSeed);
  if (start.size() > 0) first = start;
  const EigenPairs found = search(problem, count, first);
  return purified(mass, inverse, completed(problem, found));
}

Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const ShiftInverse& inverse,
                                   const EigenPairs& pairs) {
  const auto norms = [&](const Eigen::MatrixXd& columns) -> Eigen::VectorXd {
    return column_products(inverse.ranks(), columns, columns).cwiseSqrt();
  };
  const Eigen::MatrixXd forces = block_product(stiffness, pairs.vectors);
  const Eigen::MatrixXd momenta = block_product(mass, pairs.vectors);
  const Eigen::VectorXd scales =
      (pairs.values.array() == 0).select(std::abs(inverse.shift()) * norms(momenta), norms(forces));
  return norms(forces - momenta * pairs.values.asDiagonal()).cwiseQuotient(scales);
}

}  // namespace flexneck::fe_modal
