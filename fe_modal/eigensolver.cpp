// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/eigensolver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "fe_modal/block_product.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving for the modes";

/// How a search ends. Tolerances are relative to the eigenvalue theta = 1 / (lambda - shift).
struct Accuracy {
  double tolerance;
  PetscInt extra_basis;  ///< basis vectors beyond twice the number of wanted pairs
  PetscBool purify;      ///< one more solve a vector, for a small residual
};
/// The error of an eigenvector is the tolerance over the relative gap to its neighbour: 1e-10 for
/// frequencies 1 % apart.
constexpr Accuracy kFine = {1e-12, 10, PETSC_TRUE};
/// Only to tell missed eigenvalues, which are far larger, from the next one.
constexpr Accuracy kCoarse = {1e-3, 8, PETSC_FALSE};
/// Eigenvalues this close to the highest one wanted are its partners and may stay out.
constexpr double kSameValue = 1e-6;

struct Problem {
  Mat stiffness;
  Mat mass;
  const ShiftInverse* inverse;
};

/// What SLEPc calls for y = (K - shift M)^-1 x.
PetscErrorCode apply_inverse(PC preconditioner, Vec x, Vec y) {
  const ShiftInverse* inverse = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, static_cast<void*>(&inverse));
  if (code != 0) return code;
  try {
    inverse->solve(x, y);
  } catch (const ComputationError&) {
    return PETSC_ERR_LIB;  // no exception may cross SLEPc
  }
  return 0;
}

EpsHandle make_solver(const Problem& problem) {
  EpsHandle handle;
  require(EPSCreate(PETSC_COMM_SELF, handle.out()), kSolving);
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
  // PETSc hands the context back as it is; the operator is not changed through it.
  require(PCShellSetContext(inverse, const_cast<ShiftInverse*>(problem.inverse)), kSolving);
  require(PCShellSetApply(inverse, apply_inverse), kSolving);
  return handle;
}

EigenPairs take_over(EPS eps, const Problem& problem, Eigen::Index count, Eigen::Index size) {
  EigenPairs pairs{Eigen::VectorXd(count), Eigen::MatrixXd(size, count)};
  VecHandle momentum;
  require(MatCreateVecs(problem.mass, nullptr, momentum.out()), kSolving);
  for (Eigen::Index k = 0; k < count; ++k) {
    const VecHandle vector = column_vector(pairs.vectors, k);
    require(EPSGetEigenpair(eps, static_cast<PetscInt>(k), &pairs.values[k], nullptr, vector.get(),
                            nullptr),
            kSolving);
    double modal_mass = 0;
    require(MatMult(problem.mass, vector.get(), momentum.get()), kSolving);
    require(VecDot(vector.get(), momentum.get(), &modal_mass), kSolving);
    pairs.vectors.col(k) /= std::sqrt(modal_mass);
  }
  return pairs;
}

/// The start of a search. A Krylov space sees of each eigenspace only what its start has of it; a
/// search that starts where the last one did is orthogonal to the copies which that one missed.
Eigen::VectorXd start_vector(Eigen::Index size, Eigen::Index found) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(found) + 1);
  Eigen::VectorXd start(size);
  // Not std::uniform_real_distribution, whose numbers differ from library to library.
  for (double& x : start) x = std::ldexp(static_cast<double>(generator() >> 11U), -53) - 0.5;
  return start;
}

/// The `count` eigenpairs nearest to the shift that are M-orthogonal to the columns of `found`.
EigenPairs search(const Problem& problem, Eigen::Index count, const Accuracy& accuracy,
                  const Eigen::MatrixXd& found, const Eigen::VectorXd& given_start = {}) {
  PetscInt size = 0;
  require(MatGetSize(problem.mass, &size, nullptr), kSolving);
  const EpsHandle handle = make_solver(problem);
  EPS eps = handle.get();
  std::vector<VecHandle> handles;
  std::vector<Vec> deflated;
  for (Eigen::Index k = 0; k < found.cols(); ++k) {
    handles.push_back(column_vector(found, k));
    deflated.push_back(handles.back().get());
  }
  if (!deflated.empty()) {
    require(EPSSetDeflationSpace(eps, static_cast<PetscInt>(deflated.size()), deflated.data()),
            kSolving);
  }
  const Eigen::VectorXd start =
      given_start.size() > 0 ? given_start : start_vector(size, found.cols());
  const VecHandle start_handle = vector_on({start.data(), static_cast<std::size_t>(size)});
  Vec start_space = start_handle.get();
  require(EPSSetInitialSpace(eps, 1, &start_space), kSolving);
  const auto wanted = static_cast<PetscInt>(count);
  const PetscInt room = size - static_cast<PetscInt>(found.cols());
  require(EPSSetDimensions(eps, wanted, std::min(room, 2 * wanted + accuracy.extra_basis),
                           PETSC_DEFAULT),
          kSolving);
  require(EPSSetTolerances(eps, accuracy.tolerance, 200), kSolving);
  require(EPSSetPurify(eps, accuracy.purify), kSolving);
  require(EPSSolve(eps), kSolving);
  PetscInt converged = 0;
  require(EPSGetConverged(eps, &converged), kSolving);
  if (converged < wanted) {
    throw ComputationError("the eigensolver found " + std::to_string(converged) + " of " +
                           std::to_string(wanted) + " modes");
  }
  return take_over(eps, problem, count, size);
}

EigenPairs merge(const EigenPairs& one, const EigenPairs& other) {
  Eigen::VectorXd values(one.values.size() + other.values.size());
  values << one.values, other.values;
  Eigen::MatrixXd vectors(one.vectors.rows(), values.size());
  vectors << one.vectors, other.vectors;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return {values(order), vectors(Eigen::all, order)};
}

}  // namespace

EigenPairs lowest_eigenpairs(Mat stiffness, Mat mass, const ShiftInverse& inverse,
                             Eigen::Index count, const Eigen::VectorXd& start) {
  if (std::optional<EigenPairs> own = inverse.iterate(mass, count)) return *std::move(own);
  const Problem problem{stiffness, mass, &inverse};
  EigenPairs pairs = search(problem, count, kFine, Eigen::MatrixXd(), start);
  const Eigen::Index size = pairs.vectors.rows();
  while (pairs.values.size() < size) {
    const double highest = pairs.values[count - 1] - inverse.shift();
    const double next = search(problem, 1, kCoarse, pairs.vectors).values[0] - inverse.shift();
    if (next > highest * (1 - kSameValue)) break;
    pairs = merge(pairs, search(problem, 1, kFine, pairs.vectors));
  }
  return {pairs.values.head(count), pairs.vectors.leftCols(count)};
}

Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const EigenPairs& pairs, double shift) {
  Eigen::VectorXd residuals(pairs.values.size());
  for (Eigen::Index k = 0; k < residuals.size(); ++k) {
    const Eigen::VectorXd force = block_product(stiffness, pairs.vectors.col(k));
    const Eigen::VectorXd momentum = block_product(mass, pairs.vectors.col(k));
    const double scale = pairs.values[k] == 0 ? std::abs(shift) * momentum.norm() : force.norm();
    residuals[k] = (force - pairs.values[k] * momentum).norm() / scale;
  }
  return residuals;
}

}  // namespace flexneck::fe_modal
