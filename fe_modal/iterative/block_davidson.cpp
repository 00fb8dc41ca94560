// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/iterative/block_davidson.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kGuards = 4;         ///< columns beyond those wanted
constexpr Eigen::Index kBlocksOfBasis = 5;  ///< when the basis is that wide, it is cut back
constexpr int kMostIterations = 500;
/// Of r^T P r / lambda, which estimates the relative error of lambda if P is near K^-1: that of
/// shapes is its root.
constexpr double kTolerance = 1e-14;
/// Columns that are so much shorter after orthogonalisation have nothing new.
constexpr double kNothingNew = 1e-10;

/// V, K V, M V with V^T M V = 1.
struct Basis {
  Eigen::MatrixXd vectors;
  Eigen::MatrixXd forces;
  Eigen::MatrixXd momenta;

  void turn(const Eigen::MatrixXd& combination) {
    vectors = (vectors * combination).eval();
    forces = (forces * combination).eval();
    momenta = (momenta * combination).eval();
  }
  void append(const Basis& more) {
    const auto join = [](Eigen::MatrixXd& own, const Eigen::MatrixXd& other) {
      const Eigen::Index columns = own.cols();
      own.conservativeResize(other.rows(), columns + other.cols());
      own.rightCols(other.cols()) = other;
    };
    join(vectors, more.vectors);
    join(forces, more.forces);
    join(momenta, more.momenta);
  }
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
Basis orthonormal(const Basis& basis, Eigen::MatrixXd block, const BlockOperator& stiffness,
                  const BlockOperator& mass) {
  Eigen::MatrixXd momenta = mass(block);
  for (int pass = 0; pass < 2; ++pass) {
    if (basis.vectors.cols() > 0) {
      const Eigen::MatrixXd shares = basis.vectors.transpose() * momenta;
      block -= basis.vectors * shares;
      momenta -= basis.momenta * shares;
    }
    Eigen::MatrixXd gram = block.transpose() * momenta;
    const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    gram = (scale.asDiagonal() * gram * scale.asDiagonal()).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::VectorXd& lengths = solver.eigenvalues();
    const Eigen::Index dropped = (lengths.array() < kNothingNew).count();
    const Eigen::Index kept = lengths.size() - dropped;
    const Eigen::MatrixXd combination = scale.asDiagonal() * solver.eigenvectors().rightCols(kept) *
                                        lengths.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    block = (block * combination).eval();
    momenta = (momenta * combination).eval();
  }
  return {block, stiffness(block), momenta};
}

}  // namespace

DavidsonResult block_davidson(const BlockOperator& stiffness, const BlockOperator& mass,
                              const BlockOperator& preconditioner, Eigen::Index size,
                              Eigen::Index count) {
  const Eigen::Index width = std::min(count + kGuards, size);
  Basis basis;
  Eigen::MatrixXd block = preconditioner(mass(random_block(size, width)));
  for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
    const Basis more = orthonormal(basis, std::move(block), stiffness, mass);
    if (more.vectors.cols() == 0) break;
    basis.append(more);
    const Eigen::MatrixXd reduced = basis.vectors.transpose() * basis.forces;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(reduced);
    const Eigen::VectorXd values = ritz.eigenvalues().head(std::min(width, reduced.rows()));
    const Eigen::MatrixXd best = ritz.eigenvectors().leftCols(values.size());
    const Eigen::MatrixXd residuals =
        basis.forces * best - basis.momenta * (best * values.asDiagonal());
    block = preconditioner(residuals);
    const Eigen::VectorXd errors =
        block.cwiseProduct(residuals).colwise().sum().transpose().cwiseQuotient(values);
    if (errors.head(count).maxCoeff() < kTolerance || basis.vectors.cols() == size) {
      return {{values.head(count), basis.vectors * best.leftCols(count)}, iteration};
    }
    if (basis.vectors.cols() + width > kBlocksOfBasis * width) {
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
