// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/iteration_matrix.h"

#include <algorithm>
#include <cmath>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Of differences, in m, rad and kg^(1/2) m and their rates: Newton's method needs few digits.
constexpr double kDifference = 1e-7;

}  // namespace

IterationMatrix::IterationMatrix(const Equations& equations, Index state_size)
    : nq_(equations.layout().positions),
      nv_(equations.layout().velocities),
      nc_(equations.layout().constraints),
      mass_(nv_, nv_),
      damping_(nv_, nv_),
      stiffness_(nv_, nv_),
      rows_transposed_(nv_, nc_),
      factors_(nv_ + nc_),
      base_(nv_ + nc_),
      moved_(nv_ + nc_),
      state_(state_size),
      rate_(Vector::Zero(state_size)),
      right_(nv_ + nc_),
      change_(Vector::Zero(nv_)) {
  redundant_.reserve(static_cast<std::size_t>(nc_));
  redundant_elsewhere_.reserve(static_cast<std::size_t>(nc_));
}

bool IterationMatrix::leaves_out_only_redundant(Equations& equations, double time_s,
                                                const Vector& state) {
  if (redundant_.empty()) return true;
  equations.derivative(time_s, state, rate_);
  equations.redundant_rows(redundant_elsewhere_);
  return std::includes(redundant_elsewhere_.begin(), redundant_elsewhere_.end(), redundant_.begin(),
                       redundant_.end());
}

void IterationMatrix::linearise(Equations& equations, double time_s, const Vector& state,
                                const Vector& accelerations, const Vector& multipliers) {
  // Which rows are redundant is known of the last configuration that was factorised.
  if (nc_ > 0) equations.derivative(time_s, state, rate_);
  equations.redundant_rows(redundant_);
  equations.residual(time_s, state, accelerations, multipliers, base_);
  equations.inertia(mass_, rows_transposed_);
  state_ = state;
  for (Index i = 0; i < nv_; ++i) {
    const double rate = state[nq_ + i];
    const double step = kDifference * std::max(1.0, std::abs(rate));
    state_[nq_ + i] = rate + step;
    equations.residual(time_s, state_, accelerations, multipliers, moved_);
    damping_.col(i) = (moved_ - base_).head(nv_) / step;
    state_[nq_ + i] = rate;

    change_[i] = kDifference;
    equations.retract(state_.head(nq_), change_);
    equations.residual(time_s, state_, accelerations, multipliers, moved_);
    stiffness_.col(i) = (moved_ - base_).head(nv_) / kDifference;
    state_.head(nq_) = state.head(nq_);
    change_[i] = 0;
  }
}

void IterationMatrix::factorise(double q, double v) {
  q_ = q;
  MatrixXd& matrix = factors_.matrix();
  matrix.topLeftCorner(nv_, nv_) = mass_ + v * damping_ + q * stiffness_;
  matrix.topRightCorner(nv_, nc_) = rows_transposed_;
  matrix.bottomLeftCorner(nc_, nv_) = rows_transposed_.transpose();
  matrix.bottomRightCorner(nc_, nc_).setZero();
  for (const Index row : redundant_) {
    matrix.row(nv_ + row).setZero();
    matrix.col(nv_ + row).setZero();
    matrix(nv_ + row, nv_ + row) = 1;
  }
  factors_.factorise();
}

void IterationMatrix::solve(Vector& residual) {
  right_.head(nv_) = -residual.head(nv_);
  right_.tail(nc_) = residual.tail(nc_) / -q_;
  for (const Index row : redundant_) right_[nv_ + row] = 0;
  factors_.solve(right_);
  residual = right_;
}

void IterationMatrix::filter(Vector& change) {
  right_.setZero();
  right_.head(nv_).noalias() = mass_ * change;
  factors_.solve(right_);
  change = right_.head(nv_);
}

}  // namespace flexneck::multibody
