// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/block_davidson.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/QR>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/random_block.h"
#include "fe_modal/algebra/row_panels.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kGuards = 4;         ///< columns beyond those wanted
constexpr Eigen::Index kBlocksOfBasis = 4;  ///< when the basis is that wide, it is cut back
constexpr std::uint64_t kSeed = 1;
/// Columns that are so much shorter after orthogonalisation have nothing new.
constexpr double kNothingNew = 1e-10;
/// Of squares of what a second orthogonalisation leaves of unit columns: those that have less were
/// rounding, and the basis spans all that can move.
constexpr double kRounding = 0.25;

Eigen::MatrixXd product(const MatrixView& columns, const MatrixView& combination) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns.rows(), combination.cols());
  multiply(1, columns, combination, 0, result);
  return result;
}

/// The basis V, V^T M V = 1, and V^T K V. K V and M V are not kept, for products with K and M are
/// cheap beside the preconditioner. Memory is taken once: at a million degrees of freedom it would
/// not do to copy it.
class Basis {
 public:
  Basis(const Ranks& ranks, Eigen::Index own_size, Eigen::Index capacity)
      : ranks_(ranks),
        vectors_(own_size, capacity),
        projected_(Eigen::MatrixXd::Zero(capacity, capacity)) {}

  Eigen::Index count() const { return count_; }
  Eigen::Index capacity() const { return vectors_.cols(); }
  auto vectors() const { return vectors_.leftCols(count_); }
  auto projected() const { return projected_.topLeftCorner(count_, count_); }

  /// @param forces K times the block
  void append(const Eigen::MatrixXd& block, const Eigen::MatrixXd& forces) {
    const Eigen::Index columns = block.cols();
    vectors_.middleCols(count_, columns) = block;
    count_ += columns;
    const Eigen::MatrixXd shares = inner_products(ranks_, vectors(), forces);
    projected_.block(0, count_ - columns, count_, columns) = shares;
    projected_.block(count_ - columns, 0, columns, count_) = shares.transpose();
  }
  /// Keeps combinations of the columns.
  /// @param combination orthonormal
  void cut_back(const Eigen::MatrixXd& combination) {
    for_each_panel(vectors_.rows(), [&](Eigen::Index first, Eigen::Index count) {
      auto rows = vectors_.middleRows(first, count);
      const Eigen::MatrixXd turned = product(rows.leftCols(count_), combination);
      rows.leftCols(combination.cols()) = turned;
    });
    const Eigen::MatrixXd turned = combination.transpose() * projected() * combination;
    count_ = combination.cols();
    projected_.topLeftCorner(count_, count_) = turned;
  }

 private:
  Ranks ranks_;
  Eigen::MatrixXd vectors_;
  Eigen::MatrixXd projected_;
  Eigen::Index count_ = 0;
};

/// What of the columns is M-orthogonal to the basis, M-orthonormal among themselves.
Eigen::MatrixXd orthonormal(const Ranks& ranks, const Basis& basis, Eigen::MatrixXd block,
                            Mat mass) {
  Eigen::MatrixXd momenta = block_product(mass, block);
  for (int pass = 0; pass < 2; ++pass) {
    if (basis.count() > 0) {
      multiply(-1, basis.vectors(), inner_products(ranks, basis.vectors(), momenta), 1, block);
      // What a second pass takes out is rounding: by V^T M V = 1 the products with M X before it
      // are those after it.
      if (pass == 0) momenta = block_product(mass, block);
    }
    Eigen::MatrixXd gram = inner_products(ranks, block, momenta);
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(gram.cols());
    if (pass == 0) scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    gram = (scale.asDiagonal() * gram * scale.asDiagonal()).eval();
    const auto [lengths, vectors] = symmetric_pairs(gram);
    const Eigen::Index dropped = (lengths.array() < (pass == 0 ? kNothingNew : kRounding)).count();
    const Eigen::Index kept = lengths.size() - dropped;
    const Eigen::MatrixXd combination = scale.asDiagonal() * vectors.rightCols(kept) *
                                        lengths.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    block = product(block, combination);
    if (pass == 0) momenta = product(momenta, combination);
  }
  return block;
}

/// The Ritz vectors and those of the iteration before, which make it converge as if the basis had
/// not been cut back (Stathopoulos and Saad, Electron. Trans. Numer. Anal. 7 (1998) 163).
/// @param best, before of the basis now and then, which has grown since; orthonormal
Eigen::MatrixXd restart_combination(const Eigen::MatrixXd& best, const Eigen::MatrixXd& before) {
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(best.rows(), best.cols() + before.cols());
  both.leftCols(best.cols()) = best;
  both.topRightCorner(before.rows(), before.cols()) = before;
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(both);
  return factors.householderQ() * Eigen::MatrixXd::Identity(both.rows(), both.cols());
}

}  // namespace

std::optional<DavidsonResult> block_davidson(const Ranks& ranks, const BlockOperator& stiffness,
                                             Mat mass, const BlockOperator& preconditioner,
                                             Eigen::Index count, const DavidsonLimits& limits) {
  const Eigen::Index size = size_of(mass);
  const Eigen::Index width = std::min(count + kGuards, size);
  Eigen::MatrixXd block = random_block(mass, width, kSeed);
  // Of a small body a block may be added when little is left to find.
  Basis basis(ranks, block.rows(), std::min(kBlocksOfBasis * width, size + width));
  block = preconditioner(block_product(mass, block));
  const auto residuals_of = [&](const Eigen::MatrixXd& vectors, const Eigen::VectorXd& values) {
    Eigen::MatrixXd residuals = stiffness(vectors);
    residuals -= block_product(mass, vectors) * values.asDiagonal();
    return residuals;
  };
  Eigen::MatrixXd before;
  for (int iteration = 1; iteration <= limits.max_iterations; ++iteration) {
    block = orthonormal(ranks, basis, std::move(block), mass);
    if (block.cols() == 0) break;
    basis.append(block, stiffness(block));
    const SymmetricPairs ritz = symmetric_pairs(basis.projected());
    const Eigen::VectorXd values = ritz.values.head(std::min(width, basis.count()));
    const Eigen::MatrixXd best = ritz.vectors.leftCols(values.size());
    block.resize(0, 0);  // the preconditioner needs memory, so nothing else is kept meanwhile
    const Eigen::MatrixXd residuals = residuals_of(product(basis.vectors(), best), values);
    block = preconditioner(residuals);
    const Eigen::VectorXd errors = column_products(ranks, block, residuals).cwiseQuotient(values);
    // Of a block whose columns depend on one another there may be fewer.
    const bool has_settled =
        values.size() >= count && errors.head(count).maxCoeff() < limits.tolerance;
    if (has_settled || basis.count() >= size) {
      EigenPairs lowest{values.head(count), product(basis.vectors(), best).leftCols(count)};
      if (values.size() > count) lowest.next = values[count];
      return DavidsonResult{std::move(lowest), iteration};
    }
    if (basis.count() + width > basis.capacity()) {
      const Eigen::MatrixXd combination = restart_combination(best, before);
      basis.cut_back(combination);
      before = Eigen::MatrixXd::Identity(combination.cols(), best.cols());
    } else {
      before = best;
    }
    // What has converged needs no more.
    Eigen::Index open = 0;
    for (Eigen::Index k = 0; k < errors.size(); ++k) {
      if (errors[k] >= limits.tolerance) block.col(open++) = block.col(k);
    }
    if (open == 0) break;
    block.conservativeResize(Eigen::NoChange, open);
  }
  return std::nullopt;
}

}  // namespace flexneck::fe_modal
