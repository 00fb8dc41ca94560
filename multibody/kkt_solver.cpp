// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/kkt_solver.h"

#include <algorithm>
#include <cmath>

#include "multibody/cholesky.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A row whose pivot falls below this share of its diagonal depends on those before.
constexpr double kRedundant = 1e-11;

}  // namespace

KktSolver::KktSolver(const std::vector<Index>& body_sizes, const std::vector<JointPlace>& joints) {
  for (const Index size : body_sizes) {
    bodies_.push_back({velocity_count_, Eigen::MatrixXd(size, size)});
    velocity_count_ += size;
  }
  const auto rows_on = [&](std::size_t body) {
    const Index size = body == JointPlace::kNoBody ? 0 : body_sizes[body];
    return TransposedRows(size, kMaxRows);
  };
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const JointPlace& place = joints[k];
    joints_.push_back({place,
                       constraint_count_,
                       rows_on(place.body_i),
                       rows_on(place.body_j),
                       k,
                       0,
                       RowVector::Zero(),
                       {}});
    constraint_count_ += place.rows;
    add_meetings(k);
  }
  std::size_t blocks = 0;
  for (const Meeting& meeting : meetings_) {
    std::size_t& first = joints_[meeting.row_joint].first;
    first = std::min(first, meeting.column_joint);
  }
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    joints_[k].blocks = blocks;
    blocks += k - joints_[k].first + 1;
  }
  schur_.resize(blocks);
}

KktSolver::Block& KktSolver::block(std::size_t row_joint, std::size_t column_joint) {
  const JointBlock& row = joints_[row_joint];
  return schur_[row.blocks + column_joint - row.first];
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

void KktSolver::set_mass(std::size_t body, const Eigen::MatrixXd& mass) {
  bodies_[body].factor = mass;
}

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
  for (Block& part : schur_) part.setZero();
  for (const Meeting& meeting : meetings_) {
    const JointBlock& row = joints_[meeting.row_joint];
    const JointBlock& column = joints_[meeting.column_joint];
    const TransposedRows& Y_row = meeting.row_is_i ? row.Y_i : row.Y_j;
    const TransposedRows& Y_column = meeting.column_is_i ? column.Y_i : column.Y_j;
    Block& sum = block(meeting.row_joint, meeting.column_joint);
    // A column at a time stays in registers.
    for (Index c = 0; c < kMaxRows; ++c) {
      RowVector column_sum = RowVector::Zero();
      for (Index k = 0; k < Y_row.rows(); ++k)
        column_sum += Y_column(k, c) * Y_row.row(k).transpose();
      sum.col(c) += column_sum;
    }
  }
}

void KktSolver::factorise_schur_complement() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Block& diagonal = block(i, i);
    const RowVector before = diagonal.diagonal();
    for (std::size_t j = joints_[i].first; j < i; ++j) {
      // L_ij = (S_ij - sum_k L_ik L_jk^T) L_jj^-T.
      Block& L_ij = block(i, j);
      for (std::size_t k = std::max(joints_[i].first, joints_[j].first); k < j; ++k)
        L_ij.noalias() -= block(i, k).lazyProduct(block(j, k).transpose());
      const Block& L_jj = block(j, j);
      for (Index c = 0; c < kMaxRows; ++c) {
        L_ij.col(c) *= L_jj(c, c);
        for (Index later = c + 1; later < kMaxRows; ++later)
          L_ij.col(later) -= L_jj(later, c) * L_ij.col(c);
      }
      diagonal.noalias() -= L_ij.lazyProduct(L_ij.transpose());
    }
    factorise_diagonal(joints_[i], before, diagonal);
  }
}

/// As factorise_cholesky, but a row whose pivot is rounding of what it was before is left out: with
/// a zero in place of the pivot's inverse and of its column, solving gives it a zero.
void KktSolver::factorise_diagonal(JointBlock& joint, const RowVector& before, Block& diagonal) {
  // Padding: rows that the joint lacks are zero.
  for (Index r = joint.place.rows; r < kMaxRows; ++r) diagonal(r, r) = 1;
  for (Index k = 0; k < kMaxRows; ++k) {
    const bool left_out = k < joint.place.rows && diagonal(k, k) <= kRedundant * before[k];
    joint.left_out[static_cast<std::size_t>(k)] = left_out;
    const double scale = left_out ? 0 : 1 / std::sqrt(diagonal(k, k));
    diagonal(k, k) = scale;
    for (Index i = k + 1; i < kMaxRows; ++i) diagonal(i, k) *= scale;
    for (Index j = k + 1; j < kMaxRows; ++j)
      for (Index i = j; i < kMaxRows; ++i) diagonal(i, j) -= diagonal(j, k) * diagonal(i, k);
  }
}

void KktSolver::solve_schur_complement() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    RowVector& lambda = joints_[i].lambda;
    for (std::size_t k = joints_[i].first; k < i; ++k)
      lambda.noalias() -= block(i, k).lazyProduct(joints_[k].lambda);
    solve_lower(block(i, i), lambda);
  }
  for (std::size_t i = joints_.size(); i-- > 0;) {
    RowVector& lambda = joints_[i].lambda;
    solve_upper(block(i, i), lambda);
    for (std::size_t k = joints_[i].first; k < i; ++k)
      joints_[k].lambda.noalias() -= block(i, k).transpose().lazyProduct(lambda);
  }
}

void KktSolver::solve(Eigen::Ref<VectorXd> r, Eigen::Ref<VectorXd> s) {
  const auto segment = [&](std::size_t body) {
    return r.segment(bodies_[body].offset, bodies_[body].factor.rows());
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b) solve_lower(bodies_[b].factor, segment(b));

  // S lambda = B M^-1 r - s.
  for (JointBlock& joint : joints_) {
    joint.lambda.setZero();
    joint.lambda.head(joint.place.rows) = -s.segment(joint.offset, joint.place.rows);
    const auto add = [&](std::size_t body, const TransposedRows& Y) {
      if (body == JointPlace::kNoBody) return;
      const auto z = segment(body);
      for (Index k = 0; k < Y.rows(); ++k) joint.lambda += z[k] * Y.row(k).transpose();
    };
    add(joint.place.body_i, joint.Y_i);
    add(joint.place.body_j, joint.Y_j);
  }
  solve_schur_complement();

  // x = L^-T (z - Y lambda).
  for (const JointBlock& joint : joints_) {
    s.segment(joint.offset, joint.place.rows) = joint.lambda.head(joint.place.rows);
    const auto subtract = [&](std::size_t body, const TransposedRows& Y) {
      if (body == JointPlace::kNoBody) return;
      auto z = segment(body);
      for (Index k = 0; k < Y.rows(); ++k) z[k] -= Y.row(k).dot(joint.lambda);
    };
    subtract(joint.place.body_i, joint.Y_i);
    subtract(joint.place.body_j, joint.Y_j);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) solve_upper(bodies_[b].factor, segment(b));
}

std::vector<KktSolver::RedundantRow> KktSolver::redundant_rows() const {
  std::vector<RedundantRow> rows;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    for (Index r = 0; r < joints_[joint].place.rows; ++r)
      if (joints_[joint].left_out[static_cast<std::size_t>(r)]) rows.push_back({joint, r});
  return rows;
}

}  // namespace flexneck::multibody
