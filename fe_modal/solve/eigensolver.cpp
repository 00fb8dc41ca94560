// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/eigensolver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSearching = "solving the eigenproblem";

/// Required accuracy of a search.
struct Accuracy {
  double residual;  ///< residual of (K - shift M)^-1 M over its theta = 1 / (lambda - shift)
  /// Vectors of the Krylov space beyond two for each requested pair: with so many the first space
  /// nearly always suffices. Ten modes of the neck need 28 vectors at 26 388 degrees of freedom and
  /// 30 at 191 388; with two fewer the search restarts and takes half as long again.
  Eigen::Index more_vectors;
  bool takes_choices = true;  ///< true if options that a user chose apply
};
/// Accuracy for eigenvectors. Their error is the residual over the relative gap to the neighbour:
/// 1e-10 for frequencies 1 % apart.
constexpr Accuracy kOfVectors{1e-12, 10};
/// Accuracy for eigenvalues alone: their error is of the order of the square of the residual.
constexpr Accuracy kOfValues{1e-8, 2};
/// Accuracy for a pair that only shows that none is missing.
constexpr Accuracy kOfNext{1e-3, 6, false};
/// Relative margin for a pair found beside the others: it was missed among them if its eigenvalue
/// is below the last one's by more than this fraction, or is a copy of the last if it is not above
/// it by more.
constexpr double kSame = 1e-7;
constexpr PetscInt kRestarts = 200;

/// Pseudo-random number between -1/2 and 1/2 that depends on its index alone (the mixer of
/// splitmix64).
double random_entry(std::uint64_t place) {
  std::uint64_t bits = (place + 1) * 0x9e3779b97f4a7c15U;
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
  return std::ldexp(static_cast<double>((bits ^ (bits >> 31U)) >> 11U), -53) - 0.5;
}

/// Start vector of a search. Each search in the same space has its own: for a multiple eigenvalue
/// the first one finds only the eigenvector that its start vector contains, and nothing else
/// remains of that vector. It is the same for any number of ranks.
Eigen::MatrixXd start_vector(Mat matrix, std::uint64_t search) {
  PetscInt first = 0;
  PetscInt end = 0;
  require(MatGetOwnershipRange(matrix, &first, &end), kSearching);
  Eigen::MatrixXd start(end - first, 1);
  for (PetscInt row = first; row < end; ++row)
    start(row - first, 0) = random_entry((search << 32U) + static_cast<std::uint64_t>(row));
  return start;
}

/// An EPS with the solver's factor: A x = theta B x, with shift-invert about zero or without.
class Search {
 public:
  /// @param a, b  the inverse is that of A with STSINVERT, and of B with STSHIFT
  Search(Mat a, Mat b, const LinearSolver& inverse, STType transform)
      : inverse_(inverse), operators_{a, b} {
    require(EPSCreate(communicator(inverse.ranks()), eps_.out()), kSearching);
    EPS eps = eps_.get();
    require(EPSSetOperators(eps, a, b), kSearching);
    require(EPSSetProblemType(eps, EPS_GHEP), kSearching);
    require(EPSSetType(eps, EPSKRYLOVSCHUR), kSearching);
    require(EPSGetST(eps, &transform_), kSearching);
    require(STSetType(transform_, transform), kSearching);
    require(STSetKSP(transform_, inverse.ksp()), kSearching);
    // Purification would take a solve for each vector, one by one.
    require(EPSSetPurify(eps, PETSC_FALSE), kSearching);
  }
  /// Detaches the solver, since an EPS resets its solver and this one is used further.
  ~Search() {
    KspHandle none;
    if (KSPCreate(communicator(inverse_.ranks()), none.out()) == 0)
      static_cast<void>(STSetKSP(transform_, none.get()));
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  EPS eps() const { return eps_.get(); }
  void deflate(const Eigen::MatrixXd& known) {
    std::vector<VecHandle> vectors;
    std::vector<Vec> plain;
    for (Eigen::Index k = 0; k < known.cols(); ++k) {
      vectors.push_back(column_vector(known, k, inverse_.ranks()));
      plain.push_back(vectors.back().get());
    }
    if (plain.empty()) return;
    require(EPSSetDeflationSpace(eps(), static_cast<PetscInt>(plain.size()), plain.data()),
            kSearching);
  }
  /// @param start  (own rows, 1)
  /// @return converged pairs of the problem, as many as requested or fewer
  EigenPairs solve(Eigen::Index count, const Accuracy& accuracy, const Eigen::MatrixXd& start) {
    const Eigen::Index size = size_of(operators_[0]);
    const auto vectors = static_cast<PetscInt>(std::min(size, 2 * count + accuracy.more_vectors));
    require(EPSSetDimensions(eps(), static_cast<PetscInt>(count), vectors, PETSC_DETERMINE),
            kSearching);
    require(EPSSetTolerances(eps(), accuracy.residual, kRestarts), kSearching);
    const VecHandle first = column_vector(start, 0, inverse_.ranks());
    Vec initial = first.get();
    require(EPSSetInitialSpace(eps(), 1, &initial), kSearching);
    if (accuracy.takes_choices) require(EPSSetFromOptions(eps()), kSearching);
    const PetscErrorCode code = EPSSolve(eps());
    for (Mat matrix : operators_) rethrow_from(matrix);
    require(code, kSearching);
    PetscInt converged = 0;
    require(EPSGetConverged(eps(), &converged), kSearching);
    const Eigen::Index found = std::min<Eigen::Index>(count, converged);
    EigenPairs pairs{Eigen::VectorXd(found), Eigen::MatrixXd(start.rows(), found)};
    pairs.search = describe(converged);
    for (Eigen::Index k = 0; k < found; ++k) {
      const VecHandle vector = column_vector(pairs.vectors, k, inverse_.ranks());
      require(EPSGetEigenpair(eps(), static_cast<PetscInt>(k), &pairs.values[k], nullptr,
                              vector.get(), nullptr),
              kSearching);
    }
    return pairs;
  }

 private:
  /// Text of the search, "SLEPc's krylovschur with sinvert: 12 pairs, residuals up to 3e-14; 28
  /// vectors, restarted 0 times".
  std::string describe(PetscInt converged) const {
    EPSType method = nullptr;
    STType transform = nullptr;
    PetscInt iterations = 0;
    PetscInt vectors = 0;
    double largest = 0;
    require(EPSGetType(eps(), &method), kSearching);
    require(STGetType(transform_, &transform), kSearching);
    require(EPSGetIterationNumber(eps(), &iterations), kSearching);
    require(EPSGetDimensions(eps(), nullptr, &vectors, nullptr), kSearching);
    for (PetscInt k = 0; k < converged; ++k) {
      double error = 0;
      require(EPSGetErrorEstimate(eps(), k, &error), kSearching);
      largest = std::max(largest, error);
    }
    return "SLEPc's " + std::string(method) + " with " + transform + ": " +
           std::to_string(converged) + " pairs, residuals up to " + rounded_text(largest, 2) +
           "; " + std::to_string(vectors) + " vectors, restarted " +
           std::to_string(iterations - 1) + " times";
  }

  const LinearSolver& inverse_;
  Mat operators_[2];
  EpsHandle eps_;
  ST transform_ = nullptr;
};

/// Start vector beside the known eigenvectors: a step of inverse iteration on a random vector; no
/// columns if it is only rounding, so that no further vector has mass.
Eigen::MatrixXd start_beside(Mat mass, const LinearSolver& inverse, const Eigen::MatrixXd& known,
                             std::uint64_t number) {
  constexpr double kRounding = 1e-10;
  constexpr int kPasses = 2;
  const Ranks& ranks = inverse.ranks();
  Eigen::MatrixXd start = inverse.solve(block_product(mass, start_vector(mass, number)));
  const Eigen::MatrixXd momenta = known.cols() > 0 ? block_product(mass, known) : known;
  const double whole = column_products(ranks, start, block_product(mass, start))[0];
  for (int pass = 0; pass < kPasses && known.cols() > 0; ++pass)
    start -= known * inner_products(ranks, momenta, start);
  const double left = column_products(ranks, start, block_product(mass, start))[0];
  if (!(left > kRounding * kRounding * whole)) start.resize(start.rows(), 0);
  return start;
}

/// Lowest pairs beside the known ones, ascending; fewer if there are no more.
/// @param number  index of the search in this space
EigenPairs search(Mat mass, const LinearSolver& inverse, Eigen::Index count,
                  const Accuracy& accuracy, const Eigen::MatrixXd& known, std::uint64_t number) {
  const Eigen::MatrixXd start = start_beside(mass, inverse, known, number);
  if (start.cols() == 0) return {};
  Search search(inverse.matrix(), mass, inverse, STSINVERT);
  require(EPSSetWhichEigenpairs(search.eps(), EPS_TARGET_MAGNITUDE), kSearching);
  require(EPSSetTarget(search.eps(), 0), kSearching);
  search.deflate(known);
  EigenPairs pairs = search.solve(count, accuracy, start);
  pairs.values.array() += inverse.shift();
  return pairs;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  if (left.cols() == 0) return right;
  Eigen::MatrixXd all(left.rows(), left.cols() + right.cols());
  all << left, right;
  return all;
}

/// Inserts a pair into ascending ones and drops the last.
void insert(const EigenPairs& one, EigenPairs& pairs) {
  Eigen::Index place = pairs.values.size() - 1;
  for (; place > 0 && pairs.values[place - 1] > one.values[0]; --place) {
    pairs.values[place] = pairs.values[place - 1];
    pairs.vectors.col(place) = pairs.vectors.col(place - 1).eval();
  }
  pairs.values[place] = one.values[0];
  pairs.vectors.col(place) = one.vectors.col(0);
}

/// Checks Rayleigh's quotients of K - shift M itself, for solvers whose iterations may have ended
/// early.
void check_quotients(Mat mass, const LinearSolver& inverse, const EigenPairs& pairs) {
  constexpr double kSameQuotient = 1e-6;
  const Ranks& ranks = inverse.ranks();
  const Eigen::MatrixXd& shapes = pairs.vectors;
  const Eigen::ArrayXd energies =
      column_products(ranks, shapes, block_product(inverse.matrix(), shapes));
  const Eigen::ArrayXd masses = column_products(ranks, shapes, block_product(mass, shapes));
  const Eigen::ArrayXd expected = (pairs.values.array() - inverse.shift()) * masses;
  if (((energies - expected).abs() <= kSameQuotient * expected.abs()).all()) return;
  throw ComputationError(
      "the computed eigenvalues do not satisfy the eigenproblem, since the linear solver is too "
      "inaccurate; change modes.petsc_options");
}

/// Lowest pairs beside the known ones, without gaps.
EigenPairs lowest(Mat mass, const LinearSolver& inverse, Eigen::Index count,
                  const Accuracy& accuracy, const Eigen::MatrixXd& known) {
  std::uint64_t number = 0;
  EigenPairs pairs = search(mass, inverse, count, accuracy, known, number++);
  if (pairs.values.size() < count)
    throw NotConverged("the eigensolver found " + std::to_string(pairs.values.size()) + " of " +
                       std::to_string(count) + " modes");
  const Eigen::Index others = size_of(mass) - known.cols();
  while (count > 0 && others > count) {
    const Eigen::MatrixXd all = beside(known, pairs.vectors);
    EigenPairs next = search(mass, inverse, 1, kOfNext, all, number++);
    if (next.values.size() == 0) break;
    pairs.next = next.values[0];
    if (pairs.next >= pairs.values[count - 1] * (1 - kSame)) break;
    next = search(mass, inverse, 1, accuracy, all, number++);
    if (next.values.size() == 0) throw NotConverged("the eigensolver missed a mode");
    insert(next, pairs);
  }
  if (inverse.iterates()) check_quotients(mass, inverse, pairs);
  return pairs;
}

/// Applies a step of inverse iteration to all vectors at once, which removes components without
/// mass.
void purify(Mat mass, const LinearSolver& inverse, EigenPairs& pairs) {
  const Eigen::ArrayXd scales = pairs.values.array() - inverse.shift();
  pairs.vectors = inverse.solve(block_product(mass, pairs.vectors) * scales.matrix().asDiagonal());
}

}  // namespace

EigenPairs lowest_eigenpairs(Mat mass, const LinearSolver& inverse, Eigen::Index count,
                             const Eigen::MatrixXd& known) {
  EigenPairs pairs = lowest(mass, inverse, count, kOfVectors, known);
  purify(mass, inverse, pairs);
  return pairs;
}

Eigen::VectorXd lowest_eigenvalues(Mat mass, const LinearSolver& inverse, Eigen::Index count) {
  return lowest(mass, inverse, count, kOfValues, {}).values;
}

double largest_eigenvalue(Mat a, const LinearSolver& inverse, double of_interest) {
  constexpr Accuracy kAccuracy{1e-9, 6};
  struct Floor {
    double of_interest;
  } floor{of_interest};
  // An eigenvalue counts as converged, too, once it has settled below the smallest one of interest.
  const auto relative_error = [](EPS eps, PetscScalar value, PetscScalar /*imaginary*/,
                                 PetscReal residual, PetscReal* error,
                                 void* context) -> PetscErrorCode {
    // Number of iterations after which the largest eigenvalue is known to some digits.
    constexpr PetscInt kSettled = 4;
    const double least = static_cast<const Floor*>(context)->of_interest;
    PetscInt iterations = 0;
    const PetscErrorCode code = EPSGetIterationNumber(eps, &iterations);
    if (code != 0) return code;
    const bool is_none = iterations >= kSettled && value < least;
    *error = is_none ? 0 : residual / std::max(least, std::abs(value));
    return 0;
  };
  Search search(a, inverse.matrix(), inverse, STSHIFT);
  require(EPSSetWhichEigenpairs(search.eps(), EPS_LARGEST_REAL), kSearching);
  require(EPSSetConvergenceTestFunction(search.eps(), relative_error, &floor, nullptr), kSearching);
  const EigenPairs pairs = search.solve(1, kAccuracy, start_vector(a, 0));
  if (pairs.values.size() == 0)
    throw NotConverged("the computation of the largest eigenvalue did not converge");
  return pairs.values[0];
}

Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const LinearSolver& inverse,
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
