// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/iteration_matrix.h"

#include <algorithm>
#include <cmath>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Triplet;
using Matrix = Eigen::SparseMatrix<double>;

/// Increment of the finite differences, in m, rad and kg^(1/2) m and their rates: Newton's method
/// needs few digits.
constexpr double kDifference = 1e-7;

/// Calls visit(row, column, place among the values) for each entry, column by column.
template <class Visit>
void each_entry(const Matrix& matrix, const Visit& visit) {
  for (Index c = 0; c < matrix.cols(); ++c)
    for (Index k = matrix.outerIndexPtr()[c]; k < matrix.outerIndexPtr()[c + 1]; ++k)
      visit(Index{matrix.innerIndexPtr()[k]}, c, k);
}

Index place_of(const Matrix& matrix, Index row, Index column) {
  const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
  const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
  return std::lower_bound(begin, end, static_cast<int>(row)) - matrix.innerIndexPtr();
}

}  // namespace

IterationMatrix::IterationMatrix(const Equations& equations, Index state_size)
    : nq_(equations.layout().positions),
      nv_(equations.layout().velocities),
      nc_(equations.layout().constraints),
      blocks_(equations.blocks()),
      motors_(equations.motor_rows()),
      given_(static_cast<std::size_t>(nv_), false),
      mass_(nv_, nv_),
      rows_transposed_(nv_, nc_),
      matrix_(nv_ + nc_, nv_ + nc_),
      factors_(nv_ + nc_),
      base_(nv_ + nc_),
      moved_(nv_ + nc_),
      state_(state_size),
      rate_(Vector::Zero(state_size)),
      right_(nv_ + nc_),
      change_(Vector::Zero(nv_)) {
  redundant_.reserve(static_cast<std::size_t>(nc_));
  redundant_elsewhere_.reserve(static_cast<std::size_t>(nc_));
  prepare_motion();
  equations.inertia(mass_, rows_transposed_);
  rows_transposed_.makeCompressed();
  prepare_groups();
  prepare_matrix();
}

void IterationMatrix::prepare_motion() {
  std::vector<Triplet<double>> entries;
  for (const Equations::VelocityBlock& block : blocks_)
    for (const std::size_t other : block.coupled)
      for (Index c = 0; c < block.size; ++c)
        for (Index r = 0; r < blocks_[other].size; ++r)
          entries.emplace_back(static_cast<int>(blocks_[other].begin + r),
                               static_cast<int>(block.begin + c), 0.0);
  mass_.setFromTriplets(entries.begin(), entries.end());
  damping_ = stiffness_ = mass_;
}

/// Forms groups of uncoupled blocks: each block joins the first group none of whose blocks is
/// coupled with a block coupled with it.
void IterationMatrix::prepare_groups() {
  std::vector<std::size_t> group_of(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    std::vector<bool> taken(groups_.size() + 1, false);
    for (const std::size_t equation : blocks_[b].coupled)
      for (const std::size_t other : blocks_[equation].coupled)
        if (other < b) taken[group_of[other]] = true;
    const auto free = std::find(taken.begin(), taken.end(), false) - taken.begin();
    group_of[b] = static_cast<std::size_t>(free);
    if (group_of[b] == groups_.size()) groups_.emplace_back();
    groups_[group_of[b]].push_back(b);
  }
}

void IterationMatrix::prepare_matrix() {
  std::vector<Triplet<double>> entries;
  const auto add = [&](Index row, Index column) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), 0.0);
  };
  each_entry(mass_, [&](Index row, Index column, Index) { add(row, column); });
  each_entry(rows_transposed_, [&](Index velocity, Index constraint, Index) {
    add(velocity, nv_ + constraint);
    add(nv_ + constraint, velocity);
  });
  for (Index c = 0; c < nc_; ++c) add(nv_ + c, nv_ + c);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  const auto place = [&](Index row, Index column) { return place_of(matrix_, row, column); };
  each_entry(mass_,
             [&](Index row, Index column, Index) { motion_places_.push_back(place(row, column)); });
  each_entry(rows_transposed_, [&](Index velocity, Index constraint, Index) {
    column_places_.push_back(place(velocity, nv_ + constraint));
    row_places_.push_back(place(nv_ + constraint, velocity));
  });
  for (Index c = 0; c < nc_; ++c) diagonal_places_.push_back(place(nv_ + c, nv_ + c));
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
  // The redundant rows are those of the last factorised configuration.
  if (nc_ > 0) {
    equations.derivative(time_s, state, rate_);
    equations.given_velocities(given_);
  }
  equations.redundant_rows(redundant_);
  equations.residual(time_s, state, accelerations, multipliers, base_);
  equations.inertia(mass_, rows_transposed_);
  state_ = state;
  for (const std::vector<std::size_t>& group : groups_) {
    Index size = 0;
    for (const std::size_t block : group) size = std::max(size, blocks_[block].size);
    for (Index coordinate = 0; coordinate < size; ++coordinate)
      differentiate(equations, time_s, state, accelerations, multipliers, group, coordinate);
  }
}

void IterationMatrix::differentiate(Equations& equations, double time_s, const Vector& state,
                                    const Vector& accelerations, const Vector& multipliers,
                                    const std::vector<std::size_t>& group, Index coordinate) {
  const auto each_velocity = [&](const auto& visit) {
    for (const std::size_t block : group)
      if (coordinate < blocks_[block].size) visit(blocks_[block].begin + coordinate);
  };
  const auto step = [&](Index j) { return kDifference * std::max(1.0, std::abs(state[nq_ + j])); };
  each_velocity([&](Index j) { state_[nq_ + j] += step(j); });
  equations.residual(time_s, state_, accelerations, multipliers, moved_);
  each_velocity([&](Index j) {
    take_column(j, step(j), damping_);
    state_[nq_ + j] = state[nq_ + j];
    change_[j] = kDifference;
  });
  equations.retract(state_.head(nq_), change_);
  equations.residual(time_s, state_, accelerations, multipliers, moved_);
  each_velocity([&](Index j) {
    take_column(j, kDifference, stiffness_);
    change_[j] = 0;
  });
  state_.head(nq_) = state.head(nq_);
}

void IterationMatrix::take_column(Index j, double step, Matrix& to) const {
  for (Matrix::InnerIterator each(to, j); each; ++each)
    each.valueRef() = (moved_[each.row()] - base_[each.row()]) / step;
}

void IterationMatrix::factorise(double q, double v) {
  q_ = q;
  double* const values = matrix_.valuePtr();
  for (std::size_t k = 0; k < motion_places_.size(); ++k)
    values[motion_places_[k]] =
        mass_.valuePtr()[k] + v * damping_.valuePtr()[k] + q * stiffness_.valuePtr()[k];
  for (std::size_t k = 0; k < column_places_.size(); ++k)
    values[column_places_[k]] = values[row_places_[k]] = rows_transposed_.valuePtr()[k];
  for (const Index place : diagonal_places_) values[place] = 0;
  for (const Index row : redundant_) {
    for (Index k = rows_transposed_.outerIndexPtr()[row];
         k < rows_transposed_.outerIndexPtr()[row + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      values[column_places_[entry]] = values[row_places_[entry]] = 0;
    }
    values[diagonal_places_[static_cast<std::size_t>(row)]] = 1;
  }
  factors_.factorise(matrix_);
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
  for (const Index row : motors_) right_[nv_ + row] = rows_transposed_.col(row).dot(change);
  for (const Index row : redundant_) right_[nv_ + row] = 0;
  factors_.solve(right_);
  for (Index j = 0; j < nv_; ++j)
    if (!given_[static_cast<std::size_t>(j)]) change[j] = right_[j];
}

}  // namespace flexneck::multibody
