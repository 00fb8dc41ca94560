// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/block_lanczos.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/random_block.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// The basis is cut back when it is wider than the wanted pairs by so many blocks.
constexpr Eigen::Index kBlocksOfBasis = 10;
constexpr int kMaxBlocks = 500;
/// Columns of which orthogonalisation leaves less than this share have nothing new.
constexpr double kNothingNew = 1e-12;
/// Columns of which a second orthogonalisation leaves less than this share were rounding: the basis
/// spans all that can move.
constexpr double kRounding = 0.5;

/// X and M X.
struct Columns {
  Eigen::MatrixXd vectors;
  Eigen::MatrixXd momenta;
};

/// Makes the columns M-orthonormal, one after the other, and drops those that are shorter than
/// `shortest` by then.
/// @return R, (kept, all), with the old columns = the new ones R, but for what was dropped
Eigen::MatrixXd orthonormalise(const Ranks& ranks, Columns& block,
                               const Eigen::VectorXd& shortest) {
  const Eigen::Index all = block.vectors.cols();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(all, all);
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < all; ++k) {
    Eigen::VectorXd vector = block.vectors.col(k);
    Eigen::VectorXd momentum = block.momenta.col(k);
    const Eigen::VectorXd shares = inner_products(ranks, block.vectors.leftCols(kept), momentum);
    vector.noalias() -= block.vectors.leftCols(kept) * shares;
    momentum.noalias() -= block.momenta.leftCols(kept) * shares;
    factor.col(k).head(kept) = shares;
    const double length = std::sqrt(std::max(column_products(ranks, vector, momentum)[0], 0.0));
    if (length <= shortest[k]) continue;
    factor(kept, k) = length;
    block.vectors.col(kept) = vector / length;
    block.momenta.col(kept) = momentum / length;
    ++kept;
  }
  block.vectors.conservativeResize(Eigen::NoChange, kept);
  block.momenta.conservativeResize(Eigen::NoChange, kept);
  return factor.topRows(kept);
}

/// The M-orthonormal basis V, and V^T M (K - shift M)^-1 M V. M V is not kept: it would double what
/// is stored, and a product with M is cheap beside a solve.
class Basis {
 public:
  Basis(Eigen::Index size, Eigen::Index capacity)
      : vectors_(size, capacity), projected_(Eigen::MatrixXd::Zero(capacity, capacity)) {}

  Eigen::Index count() const { return count_; }
  Eigen::Index capacity() const { return projected_.cols(); }
  auto vectors() const { return vectors_.leftCols(count_); }
  auto projected() const { return projected_.topLeftCorner(count_, count_); }

  void append(const Eigen::MatrixXd& block) {
    vectors_.middleCols(count_, block.cols()) = block;
    count_ += block.cols();
  }
  /// @param shares V^T M (K - shift M)^-1 M times the last block
  void project_last(const Eigen::MatrixXd& shares) {
    projected_.block(0, count_ - shares.cols(), count_, shares.cols()) = shares;
    projected_.block(count_ - shares.cols(), 0, shares.cols(), count_) = shares.transpose();
  }
  /// Restarts with the Ritz vectors V combination, whose Ritz values are given.
  void cut_back(const Eigen::MatrixXd& combination, const Eigen::VectorXd& values) {
    constexpr Eigen::Index kRows = 4096;
    for (Eigen::Index first = 0; first < vectors_.rows(); first += kRows) {
      auto rows = vectors_.middleRows(first, std::min(kRows, vectors_.rows() - first));
      const Eigen::MatrixXd turned = rows.leftCols(count_) * combination;
      rows.leftCols(combination.cols()) = turned;
    }
    count_ = combination.cols();
    projected_.topLeftCorner(count_, count_) = values.asDiagonal();
  }

 private:
  Eigen::MatrixXd vectors_;
  Eigen::MatrixXd projected_;
  Eigen::Index count_ = 0;
};

/// M-orthogonalises the block against the basis, twice, since once leaves rounding errors. M X is
/// computed anew each time: where little of X remains, an updated M X would be inaccurate.
/// @return {S, R} with the old block = V S + the new block R
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> orthogonalise(const Ranks& ranks, Mat mass,
                                                          const Basis& basis, Columns& block) {
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(basis.count(), block.vectors.cols());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Identity(block.vectors.cols(), block.vectors.cols());
  Eigen::VectorXd shortest =
      kNothingNew * column_products(ranks, block.vectors, block.momenta).cwiseMax(0).cwiseSqrt();
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::MatrixXd more = inner_products(ranks, basis.vectors(), block.momenta);
    multiply(-1, basis.vectors(), more, 1, block.vectors);
    block.momenta.resize(0, 0);
    block.momenta = block_product(mass, block.vectors);
    shares += more * factor;
    factor = (orthonormalise(ranks, block, shortest) * factor).eval();
    shortest = Eigen::VectorXd::Constant(block.vectors.cols(), kRounding);
  }
  return {shares, factor};
}

}  // namespace

EigenPairs block_lanczos(Mat mass, const ShiftInverse& inverse, Eigen::MatrixXd start,
                         Eigen::Index count, const Settled& settled) {
  const Ranks& ranks = inverse.ranks();
  const Eigen::Index width = start.cols();
  Basis basis(start.rows(), std::min(count + kBlocksOfBasis * width, size_of(mass)));
  Columns block{std::move(start), Eigen::MatrixXd()};
  block.momenta = block_product(mass, block.vectors);
  orthogonalise(ranks, mass, basis, block);
  RitzState state;
  for (int blocks = 0; blocks < kMaxBlocks; ++blocks) {
    const Eigen::Index last = block.vectors.cols();
    basis.append(block.vectors);
    block.vectors.resize(0, 0);  // frees it before the solution comes
    block.vectors = inverse.solve(block.momenta);
    block.momenta = block_product(mass, block.vectors);
    const auto [shares, coupling] = orthogonalise(ranks, mass, basis, block);
    basis.project_last(shares);

    const SymmetricPairs ritz = symmetric_pairs(basis.projected());
    // Largest first: these are the lowest of K.
    const Eigen::VectorXd theta = ritz.values.reverse();
    const Eigen::MatrixXd vectors = ritz.vectors.rowwise().reverse();
    const Eigen::Index found = std::min(count, theta.size());
    state.before = std::move(state.values);
    state.values = inverse.shift() + theta.head(found).cwiseInverse().array();
    state.residuals =
        (coupling * vectors.bottomLeftCorner(last, found)).colwise().norm().transpose();
    state.residuals.array() /= theta.head(found).array();
    const bool exhausted = block.vectors.cols() == 0;
    if (state.before.size() != found) state.before.resize(0);
    if (exhausted || (found == count && settled(state))) {
      return {state.values, basis.vectors() * vectors.leftCols(found)};
    }
    if (basis.count() + block.vectors.cols() > basis.capacity()) {
      const Eigen::Index kept = std::min(count + width, basis.capacity() - block.vectors.cols());
      basis.cut_back(vectors.leftCols(kept), theta.head(kept));
    }
  }
  throw ComputationError("the eigensolver has not converged in " + std::to_string(kMaxBlocks) +
                         " blocks; rounding may hide the higher modes of a body that hardly "
                         "anything holds in some motion: hold it there, or stiffen what does");
}

EigenPairs purified(Mat mass, const ShiftInverse& inverse, const EigenPairs& pairs) {
  const Eigen::MatrixXd before = block_product(mass, pairs.vectors);
  const Eigen::VectorXd distances = pairs.values.array() - inverse.shift();
  const Eigen::MatrixXd vectors =
      inverse.improve(before, pairs.vectors * distances.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd momenta = block_product(mass, vectors);
  // What was before is (K - shift M) times the new vectors.
  const Eigen::MatrixXd stiffness = inner_products(inverse.ranks(), vectors, before);
  const Eigen::MatrixXd inertia = inner_products(inverse.ranks(), vectors, momenta);
  const SymmetricPairs ritz = symmetric_pairs((stiffness + stiffness.transpose()) / 2, inertia);
  return {ritz.values.array() + inverse.shift(), vectors * ritz.vectors, pairs.next};
}

}  // namespace flexneck::fe_modal
