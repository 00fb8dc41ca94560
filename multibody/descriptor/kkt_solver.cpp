// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/kkt_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "multibody/numerics/cholesky.h"
#include "multibody/numerics/independent_rows.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Thresholds of the pivots of S as fractions of their diagonals: above the first (the square of
/// kDependent) a row that is left out may have become independent; below the second a kept row has
/// lost half of its digits.
constexpr double kIndependent = 1e-11;
constexpr double kLost = 1e-8;

}  // namespace

KktSolver::KktSolver(const std::vector<Index>& body_sizes, const std::vector<JointPlace>& joints,
                     VectorXd lengths_m)
    : lengths_m_(std::move(lengths_m)) {
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
  row_ = VectorXd::Zero(velocity_count_);
  no_rates_ = VectorXd::Zero(constraint_count_);
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

void KktSolver::factorise_bodies() {
  bool are_definite = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Eigen::MatrixXd& factor = bodies_[b].factor;
    factorise_cholesky(factor);
    if (std::isfinite(factor.diagonal().sum())) continue;
    are_definite = false;
    // The mass matrix is still there above the diagonal.
    const Eigen::MatrixXd above = factor.triangularView<Eigen::StrictlyUpper>();
    if (above.allFinite()) indefinite_body_ = b;
  }
  if (are_definite) indefinite_body_.reset();
}

void KktSolver::factorise() {
  factorise_bodies();
  for (JointBlock& joint : joints_) {
    if (joint.place.body_i != JointPlace::kNoBody)
      solve_lower(bodies_[joint.place.body_i].factor, joint.Y_i);
    if (joint.place.body_j != JointPlace::kNoBody)
      solve_lower(bodies_[joint.place.body_j].factor, joint.Y_j);
  }
  Pivots pivots = factorise_schur_complement();
  if ((pivots.lost || (pivots.appeared && !left_out_depend())) && choose_rows())
    pivots = factorise_schur_complement();
  weighted_ = pivots.lost;
  if (weighted_) factorise_weighted();
}

void KktSolver::assemble_schur_complement() {
  for (Block& part : schur_) part.setZero();
  for (const Meeting& meeting : meetings_) {
    const JointBlock& row = joints_[meeting.row_joint];
    const JointBlock& column = joints_[meeting.column_joint];
    const TransposedRows& Y_row = meeting.row_is_i ? row.Y_i : row.Y_j;
    const TransposedRows& Y_column = meeting.column_is_i ? column.Y_i : column.Y_j;
    Block& sum = block(meeting.row_joint, meeting.column_joint);
    // One column at a time stays in registers.
    for (Index c = 0; c < kMaxRows; ++c) {
      RowVector column_sum = RowVector::Zero();
      for (Index k = 0; k < Y_row.rows(); ++k)
        column_sum += Y_column(k, c) * Y_row.row(k).transpose();
      sum.col(c) += column_sum;
    }
  }
}

KktSolver::Pivots KktSolver::factorise_schur_complement() {
  assemble_schur_complement();
  Pivots pivots;
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
    factorise_diagonal(joints_[i], before, diagonal, pivots);
  }
  return pivots;
}

/// As factorise_cholesky, except for rows that are left out: the pivot's inverse and its column are
/// set to zero, so that their solution is zero.
void KktSolver::factorise_diagonal(const JointBlock& joint, const RowVector& before,
                                   Block& diagonal, Pivots& pivots) {
  // Padding: rows that the joint does not have are zero.
  for (Index r = joint.place.rows; r < kMaxRows; ++r) diagonal(r, r) = 1;
  for (Index k = 0; k < kMaxRows; ++k) {
    const bool left_out = joint.left_out[static_cast<std::size_t>(k)];
    if (left_out)
      pivots.appeared |= diagonal(k, k) > kIndependent * before[k];
    else if (k < joint.place.rows)
      pivots.lost |= !(diagonal(k, k) > kLost * before[k]);
    const double scale = left_out ? 0 : 1 / std::sqrt(diagonal(k, k));
    diagonal(k, k) = scale;
    for (Index i = k + 1; i < kMaxRows; ++i) diagonal(i, k) *= scale;
    for (Index j = k + 1; j < kMaxRows; ++j)
      for (Index i = j; i < kMaxRows; ++i) diagonal(i, j) -= diagonal(j, k) * diagonal(i, k);
  }
}

void KktSolver::copy_row(const JointBlock& joint, Index row, VectorXd& to) const {
  to.setZero();
  const auto add = [&](std::size_t body, const TransposedRows& Y) {
    if (body != JointPlace::kNoBody) to.segment(bodies_[body].offset, Y.rows()) += Y.col(row);
  };
  add(joint.place.body_i, joint.Y_i);
  add(joint.place.body_j, joint.Y_j);
}

double KktSolver::length_m(const VectorXd& z) const {
  double squares = 0;
  for (const BodyBlock& body : bodies_)
    for (Index r = 0; r < body.factor.rows(); ++r) {
      const auto L_r = body.factor.row(r).head(r);
      const double of_velocity =
          z[body.offset + r] / body.factor(r, r) + L_r.dot(z.segment(body.offset, r));
      squares += std::pow(of_velocity / lengths_m_[body.offset + r], 2);
    }
  return std::sqrt(squares);
}

/// Subtracts from each row that is left out the combination of kept rows that is nearest in the
/// mass metric: its remainder in metres is not less than that of the combination nearest in metres.
bool KktSolver::left_out_depend() {
  for (const JointBlock& joint : joints_)
    for (Index r = 0; r < joint.place.rows; ++r) {
      if (!joint.left_out[static_cast<std::size_t>(r)]) continue;
      copy_row(joint, r, row_);
      const double length = length_m(row_);
      no_rates_.setZero();
      solve_by_schur_complement(row_, no_rates_);
      if (!(length_m(row_) <= kDependent * length)) return false;
    }
  return true;
}

bool KktSolver::choose_rows() {
  const VectorXd shares = independent_shares(rows_in_metres());
  bool changed = false;
  for (JointBlock& joint : joints_)
    for (Index r = 0; r < joint.place.rows; ++r) {
      bool& left_out = joint.left_out[static_cast<std::size_t>(r)];
      const bool now = shares[joint.offset + r] == 0;
      changed |= left_out != now;
      left_out = now;
    }
  return changed;
}

void KktSolver::factorise_weighted() {
  MatrixXd Y = MatrixXd::Zero(velocity_count_, constraint_count_);
  kept_.clear();
  for (const JointBlock& joint : joints_) {
    for (Index r = 0; r < joint.place.rows; ++r)
      if (!joint.left_out[static_cast<std::size_t>(r)]) kept_.push_back(joint.offset + r);
    const auto add = [&](std::size_t body, const TransposedRows& of_body) {
      if (body == JointPlace::kNoBody) return;
      Y.block(bodies_[body].offset, joint.offset, of_body.rows(), joint.place.rows) =
          of_body.leftCols(joint.place.rows);
    };
    add(joint.place.body_i, joint.Y_i);
    add(joint.place.body_j, joint.Y_j);
  }
  weighted_elimination_.factorise(Y(Eigen::all, kept_));
}

/// B^T = L Y.
Eigen::SparseMatrix<double> KktSolver::rows_in_metres() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const JointBlock& joint : joints_) {
    const auto add = [&](std::size_t body, const TransposedRows& Y) {
      if (body == JointPlace::kNoBody) return;
      const BodyBlock& of = bodies_[body];
      for (Index r = 0; r < Y.rows(); ++r) {
        RowVector row = Y.row(r).transpose() / of.factor(r, r);
        for (Index k = 0; k < r; ++k) row += of.factor(r, k) * Y.row(k).transpose();
        for (Index c = 0; c < joint.place.rows; ++c)
          entries.emplace_back(static_cast<int>(of.offset + r), static_cast<int>(joint.offset + c),
                               row[c] / lengths_m_[of.offset + r]);
      }
    };
    add(joint.place.body_i, joint.Y_i);
    add(joint.place.body_j, joint.Y_j);
  }
  Eigen::SparseMatrix<double> rows(velocity_count_, constraint_count_);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
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
  // With z = L^-1 r and y = L^T x: [I Y; Y^T 0] [y; lambda] = [z; s].
  for (const BodyBlock& body : bodies_)
    solve_lower(body.factor, r.segment(body.offset, body.factor.rows()));
  if (weighted_)
    solve_weighted(r, s);
  else
    solve_by_schur_complement(r, s);
  for (const BodyBlock& body : bodies_)
    solve_upper(body.factor, r.segment(body.offset, body.factor.rows()));
}

void KktSolver::solve_weighted(Eigen::Ref<VectorXd> z, Eigen::Ref<VectorXd> s) {
  VectorXd lambda = s(kept_);
  weighted_elimination_.solve(z, lambda);
  s.setZero();
  s(kept_) = lambda;
}

/// S lambda = Y^T z - s, y = z - Y lambda.
void KktSolver::solve_by_schur_complement(Eigen::Ref<VectorXd> r, Eigen::Ref<VectorXd> s) {
  const auto segment = [&](std::size_t body) {
    return r.segment(bodies_[body].offset, bodies_[body].factor.rows());
  };
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
}

std::vector<KktSolver::RedundantRow> KktSolver::redundant_rows() const {
  std::vector<RedundantRow> rows;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    for (Index r = 0; r < joints_[joint].place.rows; ++r)
      if (joints_[joint].left_out[static_cast<std::size_t>(r)]) rows.push_back({joint, r});
  return rows;
}

}  // namespace flexneck::multibody
