// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/kkt_solver.h"

#include <algorithm>
#include <cmath>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Rows whose pivot falls below this share of its diagonal depend on those before.
constexpr double kRedundant = 1e-11;

}  // namespace

KktSolver::KktSolver(const std::vector<Index>& body_sizes, const std::vector<JointPlace>& joints) {
  for (const Index size : body_sizes) {
    bodies_.push_back({velocity_count_, RowMatrix(size, size)});
    velocity_count_ += size;
  }
  const auto rows_on = [&](std::size_t body) {
    const Index size = body == JointPlace::kNoBody ? 0 : body_sizes[body];
    return TransposedRows(size, kMaxRows);
  };
  for (const JointPlace& place : joints) {
    joints_.push_back({place, constraint_count_, rows_on(place.body_i), rows_on(place.body_j)});
    constraint_count_ += place.rows;
    add_meetings(joints_.size() - 1);
  }
  schur_.setZero(constraint_count_, constraint_count_);
  pivot_ratio_.setOnes(constraint_count_);
  first_.resize(static_cast<std::size_t>(constraint_count_));
  for (const JointBlock& joint : joints_)
    std::fill_n(first_.begin() + joint.offset, joint.place.rows, joint.offset);
  for (const Meeting& meeting : meetings_) {
    const JointBlock& row_joint = joints_[meeting.row_joint];
    for (Index r = row_joint.offset; r < row_joint.offset + row_joint.place.rows; ++r) {
      Index& first = first_[static_cast<std::size_t>(r)];
      first = std::min(first, joints_[meeting.column_joint].offset);
    }
  }
}

void KktSolver::add_meetings(std::size_t row_joint) {
  const JointPlace& row = joints_[row_joint].place;
  for (std::size_t k = 0; k <= row_joint; ++k) {
    const JointPlace& column = joints_[k].place;
    for (const bool row_is_i : {true, false})
      for (const bool column_is_i : {true, false}) {
        const std::size_t body = row_is_i ? row.body_i : row.body_j;
        if (body == JointPlace::kNoBody) continue;
        if (body != (column_is_i ? column.body_i : column.body_j)) continue;
        meetings_.push_back({row_joint, k, row_is_i, column_is_i});
      }
  }
}

void KktSolver::set_mass(std::size_t body, const RowMatrix& mass) { bodies_[body].factor = mass; }

void KktSolver::set_rows(std::size_t joint, const JointRows& rows) {
  joints_[joint].Y_i = rows.B_i;
  joints_[joint].Y_j = rows.B_j;
}

void KktSolver::factorise() {
  for (BodyBlock& body : bodies_) factorise_cholesky(body.factor);
  for (JointBlock& joint : joints_) {
    if (joint.place.body_i != JointPlace::kNoBody)
      solve_lower(bodies_[joint.place.body_i].factor, joint.Y_i);
    if (joint.place.body_j != JointPlace::kNoBody)
      solve_lower(bodies_[joint.place.body_j].factor, joint.Y_j);
  }
  assemble_schur_complement();
  factorise_schur_complement();
}

void KktSolver::assemble_schur_complement() {
  schur_.setZero();
  for (const Meeting& meeting : meetings_) {
    const JointBlock& row = joints_[meeting.row_joint];
    const JointBlock& column = joints_[meeting.column_joint];
    const TransposedRows& Y_row = meeting.row_is_i ? row.Y_i : row.Y_j;
    const TransposedRows& Y_column = meeting.column_is_i ? column.Y_i : column.Y_j;
    Eigen::Matrix<double, kMaxRows, kMaxRows, Eigen::RowMajor> block;
    block.setZero();
    for (Index k = 0; k < Y_row.rows(); ++k)
      block.noalias() += Y_row.row(k).transpose() * Y_column.row(k);
    schur_.block(row.offset, column.offset, row.place.rows, column.place.rows) +=
        block.topLeftCorner(row.place.rows, column.place.rows);
  }
}

void KktSolver::factorise_schur_complement() {
  for (Index i = 0; i < constraint_count_; ++i) {
    double* const row_i = &schur_(i, 0);
    const Index first_i = first_[static_cast<std::size_t>(i)];
    for (Index j = first_i; j < i; ++j) {
      const double* const row_j = &schur_(j, 0);
      double sum = row_i[j];
      for (Index k = std::max(first_i, first_[static_cast<std::size_t>(j)]); k < j; ++k)
        sum -= row_i[k] * row_j[k];
      row_i[j] = sum * row_j[j];
    }
    const double diagonal = row_i[i];
    double pivot = diagonal;
    for (Index k = first_i; k < i; ++k) pivot -= row_i[k] * row_i[k];
    pivot_ratio_[i] = pivot / diagonal;
    row_i[i] = 1 / std::sqrt(pivot);
  }
}

void KktSolver::solve(Eigen::Ref<VectorXd> r, Eigen::Ref<VectorXd> s) const {
  const auto segment = [&](std::size_t body) {
    return r.segment(bodies_[body].offset, bodies_[body].factor.rows());
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b) solve_lower(bodies_[b].factor, segment(b));

  // S lambda = B M^-1 r - s.
  s = -s;
  for (const JointBlock& joint : joints_) {
    RowVector sum = RowVector::Zero();
    const auto add = [&](std::size_t body, const TransposedRows& Y) {
      if (body == JointPlace::kNoBody) return;
      const auto z = segment(body);
      for (Index k = 0; k < Y.rows(); ++k) sum += z[k] * Y.row(k).transpose();
    };
    add(joint.place.body_i, joint.Y_i);
    add(joint.place.body_j, joint.Y_j);
    s.segment(joint.offset, joint.place.rows) += sum.head(joint.place.rows);
  }
  for (Index i = 0; i < constraint_count_; ++i) {
    for (Index k = first_[static_cast<std::size_t>(i)]; k < i; ++k) s[i] -= schur_(i, k) * s[k];
    s[i] *= schur_(i, i);
  }
  for (Index i = constraint_count_; i-- > 0;) {
    s[i] *= schur_(i, i);
    for (Index k = first_[static_cast<std::size_t>(i)]; k < i; ++k) s[k] -= schur_(i, k) * s[i];
  }

  // x = L^-T (z - Y lambda).
  for (const JointBlock& joint : joints_) {
    RowVector lambda = RowVector::Zero();
    lambda.head(joint.place.rows) = s.segment(joint.offset, joint.place.rows);
    const auto subtract = [&](std::size_t body, const TransposedRows& Y) {
      if (body == JointPlace::kNoBody) return;
      auto z = segment(body);
      for (Index k = 0; k < Y.rows(); ++k) z[k] -= Y.row(k).dot(lambda);
    };
    subtract(joint.place.body_i, joint.Y_i);
    subtract(joint.place.body_j, joint.Y_j);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) solve_upper(bodies_[b].factor, segment(b));
}

std::optional<std::size_t> KktSolver::redundant_joint() const {
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    for (Index r = 0; r < joints_[joint].place.rows; ++r)
      if (!(pivot_ratio_[joints_[joint].offset + r] > kRedundant)) return joint;
  return std::nullopt;
}

}  // namespace flexneck::multibody
