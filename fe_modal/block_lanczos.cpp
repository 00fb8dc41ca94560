// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/block_lanczos.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "fe_modal/matrix_product.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kBlock = 8;
/// Of a residual, relative to the eigenvalue. The error of a vector is this over the relative gap
/// to its neighbour: 1e-10 for frequencies 1 % apart.
constexpr double kTolerance = 1e-12;
/// Directions of a block that are this much shorter than its longest are rounding.
constexpr double kDependent = 1e-10;
/// Directions of a block no shorter than this, by the longest, stay orthogonal when normalised.
constexpr double kWellSpread = 1e-3;
/// Eigenvalues this close are copies of one.
constexpr double kSameValue = 1e-6;
constexpr int kRestarts = 100;

Eigen::MatrixXd random_block(Eigen::Index size, Eigen::Index width, std::mt19937_64& generator) {
  Eigen::MatrixXd block(size, width);
  // Not std::uniform_real_distribution, whose numbers differ from library to library.
  for (double& x : block.reshaped()) {
    x = std::ldexp(static_cast<double>(generator() >> 11U), -53) - 0.5;
  }
  return block;
}

/// One search from one start block.
class Search {
 public:
  Search(const BlockOperator& apply, const BlockOperator& mass, Eigen::Index size,
         Eigen::Index count, Eigen::Index width)
      : apply_(apply),
        mass_(mass),
        size_(size),
        count_(count),
        width_(std::min(width, size)),
        room_(std::min(size, 2 * count + 12 * width_)),
        basis_(size, room_),
        projected_(Eigen::MatrixXd::Zero(room_, room_)) {}

  /// None if it does not converge.
  std::optional<RitzPairs> run() {
    append_random();
    for (int restart = 0; restart < kRestarts; ++restart) {
      while (true) {
        expand();
        solve_projected();
        if (used_ >= count_ && converged()) return ritz_pairs();
        if (next_.cols() == 0) {
          if (used_ == room_) break;
          append_random();
        } else if (used_ + next_.cols() > room_) {
          break;
        } else {
          append(next_, mass_of_next_);
        }
      }
      restart_thick();
    }
    return std::nullopt;
  }

 private:
  auto basis() const { return basis_.leftCols(used_); }

  /// Makes a block orthogonal to the basis and to itself, and M times the block with it. Returns
  /// its parts along the basis and in `lengths` what its new columns are to be multiplied with.
  Eigen::MatrixXd orthonormalise(Eigen::MatrixXd& block, Eigen::MatrixXd& mass_of_block,
                                 Eigen::MatrixXd& lengths) {
    Eigen::MatrixXd along = Eigen::MatrixXd::Zero(used_, block.cols());
    lengths = Eigen::MatrixXd::Identity(block.cols(), block.cols());
    double negligible = kDependent * scale_;
    while (block.cols() > 0) {
      for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Kahan)
        const Eigen::MatrixXd part = transpose_times(basis(), mass_of_block);
        subtract_product(basis(), part, block);
        along += part * lengths;
        mass_of_block = mass_(block);
      }
      // By the square root of the Gram matrix, less its null space.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(block.transpose() * mass_of_block);
      const Eigen::VectorXd roots = gram.eigenvalues().cwiseMax(0).cwiseSqrt();
      const Eigen::Index kept = (roots.array() > negligible).count();
      const Eigen::MatrixXd axes = gram.eigenvectors().rightCols(kept);
      const Eigen::VectorXd sizes = roots.tail(kept);
      const Eigen::MatrixXd normalise = axes * sizes.cwiseInverse().asDiagonal();
      block = (block * normalise).eval();
      mass_of_block = (mass_of_block * normalise).eval();
      lengths = (sizes.asDiagonal() * axes.transpose() * lengths).eval();
      // Short directions have grown, and what was left in them of the others with them: once more.
      if (kept == 0 || sizes[0] > kWellSpread * sizes[kept - 1]) break;
      negligible = 0.5;
    }
    return along;
  }

  void append(const Eigen::MatrixXd& block, const Eigen::MatrixXd& mass_of_block) {
    basis_.middleCols(used_, block.cols()) = block;
    first_of_last_ = used_;
    used_ += block.cols();
    mass_of_last_ = mass_of_block;
  }

  /// New directions where the Krylov space is exhausted, or to start with.
  void append_random() {
    Eigen::MatrixXd block = random_block(size_, std::min(width_, room_ - used_), generator_);
    const double scale = std::exchange(scale_, 0.0);
    Eigen::MatrixXd mass_of_block = mass_(block);
    Eigen::MatrixXd lengths;
    orthonormalise(block, mass_of_block, lengths);
    scale_ = scale;
    append(block, mass_of_block);
  }

  /// Applies the operator to the last block and splits the result into old and new directions.
  void expand() {
    next_ = apply_(mass_of_last_);
    mass_of_next_ = mass_(next_);
    if (scale_ == 0) scale_ = std::sqrt(next_.cwiseProduct(mass_of_next_).sum());
    const Eigen::MatrixXd along = orthonormalise(next_, mass_of_next_, coupling_);
    const Eigen::Index width = used_ - first_of_last_;
    projected_.block(0, first_of_last_, used_, width) = along;
    projected_.block(first_of_last_, 0, width, used_) = along.transpose();
  }

  void solve_projected() {
    const Eigen::MatrixXd matrix = projected_.topLeftCorner(used_, used_);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver((matrix + matrix.transpose()) / 2);
    values_ = solver.eigenvalues().reverse();
    axes_ = solver.eigenvectors().rowwise().reverse();
  }

  /// Residuals of the first Ritz pairs along the next block: what the space does not hold yet.
  Eigen::MatrixXd residuals(Eigen::Index count) const {
    return coupling_ * axes_.block(first_of_last_, 0, used_ - first_of_last_, count);
  }

  bool converged() const {
    if (next_.cols() == 0) return true;
    const Eigen::VectorXd norms = residuals(count_).colwise().norm();
    return (norms.array() <= kTolerance * values_.head(count_).array()).all();
  }

  RitzPairs ritz_pairs() const { return {values_.head(count_), basis() * axes_.leftCols(count_)}; }

  /// Goes on with the best Ritz vectors and the next block.
  void restart_thick() {
    const Eigen::Index kept = std::min(count_ + width_, used_);
    const Eigen::MatrixXd best = basis() * axes_.leftCols(kept);
    basis_.leftCols(kept) = best;
    projected_.setZero();
    projected_.topLeftCorner(kept, kept) = values_.head(kept).asDiagonal();
    used_ = kept;
    if (next_.cols() > 0) {
      append(next_, mass_of_next_);
    } else {
      append_random();
    }
  }

  const BlockOperator& apply_;
  const BlockOperator& mass_;
  Eigen::Index size_;
  Eigen::Index count_;
  Eigen::Index width_;
  Eigen::Index room_;               ///< columns that the basis may have
  Eigen::Index used_ = 0;           ///< columns that it has
  Eigen::Index first_of_last_ = 0;  ///< first column of its last block
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd projected_;  ///< the operator on the basis
  Eigen::MatrixXd mass_of_last_;
  Eigen::MatrixXd next_;  ///< block that follows the last
  Eigen::MatrixXd mass_of_next_;
  Eigen::MatrixXd coupling_;  ///< the operator from the last block to the next
  Eigen::VectorXd values_;
  Eigen::MatrixXd axes_;
  double scale_ = 0;  ///< size of the operator's results
  std::mt19937_64 generator_{1};
};

/// The largest number of equal values in a row.
Eigen::Index largest_multiplicity(const Eigen::VectorXd& values) {
  Eigen::Index largest = 0;
  Eigen::Index current = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const bool same = k > 0 && values[k - 1] - values[k] < kSameValue * values[k - 1];
    current = same ? current + 1 : 1;
    largest = std::max(largest, current);
  }
  return largest;
}

}  // namespace

RitzPairs largest_eigenpairs(const BlockOperator& apply, const BlockOperator& mass,
                             Eigen::Index size, Eigen::Index count) {
  for (Eigen::Index width = kBlock;; width *= 2) {
    std::optional<RitzPairs> pairs = Search(apply, mass, size, count, width).run();
    if (!pairs) throw ComputationError("the eigensolver did not converge");
    if (width >= size || largest_multiplicity(pairs->values) < width) return *pairs;
  }
}

}  // namespace flexneck::fe_modal
