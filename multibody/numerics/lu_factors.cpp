// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/lu_factors.h"

#include <limits>

#include <Eigen/SparseLU>

namespace flexneck::multibody {

struct LuFactors::Sparse {
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factors;
  bool is_ordered = false;
};

LuFactors::LuFactors(Eigen::Index size)
    : dense_(size < kSparse ? size : 0),
      sparse_(size < kSparse ? nullptr : std::make_unique<Sparse>()) {}
LuFactors::~LuFactors() = default;
LuFactors::LuFactors(LuFactors&&) noexcept = default;
LuFactors& LuFactors::operator=(LuFactors&&) noexcept = default;

void LuFactors::factorise(const Eigen::SparseMatrix<double>& matrix) {
  if (!sparse_) {
    dense_.matrix() = matrix;
    dense_.factorise();
    return;
  }
  if (!sparse_->is_ordered) sparse_->factors.analyzePattern(matrix);
  sparse_->is_ordered = true;
  sparse_->factors.factorize(matrix);
}

void LuFactors::solve(Eigen::VectorXd& values) const {
  if (!sparse_)
    dense_.solve(values);
  else if (sparse_->factors.info() == Eigen::Success)
    values = sparse_->factors.solve(values).eval();
  else
    values.setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace flexneck::multibody
