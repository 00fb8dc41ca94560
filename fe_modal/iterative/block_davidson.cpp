// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/iterative/block_davidson.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "fe_modal/matrix_product.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kGuards = 4;         ///< columns beyond those wanted
constexpr Eigen::Index kBlocksOfBasis = 5;  ///< when the basis is that wide, it is cut back
constexpr int kMostIterations = 500;
/// Of r^T P r / lambda, which estimates the relative error of lambda if P is near K^-1: that of
/// shapes is its root.
constexpr double kTolerance = 1e-13;
/// Columns that are so much shorter after orthogonalisation have nothing new.
constexpr double kNothingNew = 1e-10;

Eigen::MatrixXd product(const MatrixView& columns, const MatrixView& combination) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns.rows(), combination.cols());
  multiply(1, columns, combination, 0, result);
  return result;
}

/// V, K V, M V with V^T M V = 1.
struct Columns {
  Eigen::MatrixXd vectors;
  Eigen::MatrixXd forces;
  Eigen::MatrixXd momenta;
};

/// As many of them as have been found, in memory that is taken once: at a million degrees of
/// freedom it would not do to copy it.
class Basis {
 public:
  Basis(Eigen::Index size, Eigen::Index capacity)
      : all_{Eigen::MatrixXd(size, capacity), Eigen::MatrixXd(size, capacity),
             Eigen::MatrixXd(size, capacity)} {}

  Eigen::Index count() const { return count_; }
  auto vectors() const { return all_.vectors.leftCols(count_); }
  auto forces() const { return all_.forces.leftCols(count_); }
  auto momenta() const { return all_.momenta.leftCols(count_); }

  void append(const Columns& more) {
    const Eigen::Index columns = more.vectors.cols();
    all_.vectors.middleCols(count_, columns) = more.vectors;
    all_.forces.middleCols(count_, columns) = more.forces;
    all_.momenta.middleCols(count_, columns) = more.momenta;
    count_ += columns;
  }
  /// Keeps combinations of the columns.
  void turn(const Eigen::MatrixXd& combination) {
    constexpr Eigen::Index kRows = 4096;
    for (Eigen::MatrixXd* const matrix : {&all_.vectors, &all_.forces, &all_.momenta}) {
      for (Eigen::Index first = 0; first < matrix->rows(); first += kRows) {
        auto rows = matrix->middleRows(first, std::min(kRows, matrix->rows() - first));
        const Eigen::MatrixXd turned = product(rows.leftCols(count_), combination);
        rows.leftCols(combination.cols()) = turned;
      }
    }
    count_ = combination.cols();
  }

 private:
  Columns all_;
  Eigen::Index count_ = 0;
};

Eigen::MatrixXd random_block(Eigen::Index size, Eigen::Index columns) {
  std::mt19937_64 generator(1);
  Eigen::MatrixXd block(size, columns);
  // Not std::uniform_real_distribution, whose numbers differ from library to library.
  for (double& x : block.reshaped()) {
    x = std::ldexp(static_cast<double>(generator() >> 11U), -53) - 0.5;
  }
  return block;
}

/// What of the columns is M-orthogonal to the basis, M-orthonormal among themselves.
Columns orthonormal(const Basis& basis, Eigen::MatrixXd block, const BlockOperator& stiffness,
                    const BlockOperator& mass) {
  Eigen::MatrixXd momenta = mass(block);
  for (int pass = 0; pass < 2; ++pass) {
    if (basis.count() > 0) {
      const Eigen::MatrixXd shares = inner_products(basis.vectors(), momenta);
      multiply(-1, basis.vectors(), shares, 1, block);
      multiply(-1, basis.momenta(), shares, 1, momenta);
    }
    Eigen::MatrixXd gram = inner_products(block, momenta);
    const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    gram = (scale.asDiagonal() * gram * scale.asDiagonal()).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::VectorXd& lengths = solver.eigenvalues();
    const Eigen::Index dropped = (lengths.array() < kNothingNew).count();
    const Eigen::Index kept = lengths.size() - dropped;
    const Eigen::MatrixXd combination = scale.asDiagonal() * solver.eigenvectors().rightCols(kept) *
                                        lengths.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    block = product(block, combination);
    momenta = product(momenta, combination);
  }
  Eigen::MatrixXd forces = stiffness(block);
  return {std::move(block), std::move(forces), std::move(momenta)};
}

}  // namespace

DavidsonResult block_davidson(const BlockOperator& stiffness, const BlockOperator& mass,
                              const BlockOperator& preconditioner, Eigen::Index size,
                              Eigen::Index count) {
  const Eigen::Index width = std::min(count + kGuards, size);
  // Of a small body a block may be added when little is left to find.
  const Eigen::Index capacity = std::min(kBlocksOfBasis * width, size + width);
  Basis basis(size, capacity);
  Eigen::MatrixXd block = preconditioner(mass(random_block(size, width)));
  for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
    const Eigen::Index before = basis.count();
    basis.append(orthonormal(basis, std::move(block), stiffness, mass));
    if (basis.count() == before) break;
    const Eigen::MatrixXd reduced = inner_products(basis.vectors(), basis.forces());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(reduced);
    const Eigen::VectorXd values = ritz.eigenvalues().head(std::min(width, reduced.rows()));
    const Eigen::MatrixXd best = ritz.eigenvectors().leftCols(values.size());
    Eigen::MatrixXd residuals = product(basis.forces(), best);
    multiply(-1, basis.momenta(), best * values.asDiagonal(), 1, residuals);
    block = preconditioner(residuals);
    const Eigen::VectorXd errors =
        block.cwiseProduct(residuals).colwise().sum().transpose().cwiseQuotient(values);
    if (errors.head(count).maxCoeff() < kTolerance || basis.count() >= size) {
      return {{values.head(count), product(basis.vectors(), best.leftCols(count))}, iteration};
    }
    if (basis.count() + width > capacity) {
      basis.turn(ritz.eigenvectors().leftCols(2 * width));
    }
    // What has converged needs no more.
    Eigen::Index open = 0;
    for (Eigen::Index k = 0; k < errors.size(); ++k) {
      if (errors[k] >= kTolerance) block.col(open++) = block.col(k);
    }
    block.conservativeResize(Eigen::NoChange, open);
  }
  throw ComputationError("the iterative eigensolver has not converged in " +
                         std::to_string(kMostIterations) + " iterations");
}

}  // namespace flexneck::fe_modal
