// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/reduced_dynamics.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Extent of the displacements of the finite differences: their error, of second order in it, and
/// rounding are then both about 1e-11 of the result.
constexpr double kDifference = 1e-5;

/// Indices of constraints that do not depend on others.
std::vector<Index> independent(const EquationsOfMotion& equations) {
  const KktSolver& solver = equations.solver();
  std::vector<Index> rows;
  for (std::size_t k = 0; k < equations.system().joints.size(); ++k)
    for (Index r = 0; r < equations.joint(k).rows; ++r)
      if (!solver.is_left_out(k, r)) rows.push_back(solver.joint_offset(k) + r);
  return rows;
}

}  // namespace

void assemble_mass(const EquationsOfMotion& equations, SparseMatrix& M) {
  const System& system = equations.system();
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const MatrixXd& mass = equations.body(b).mass;
    const Index begin = system.bodies[b].velocity;
    for (Index c = 0; c < mass.cols(); ++c)
      for (Index r = 0; r < mass.rows(); ++r) M.coeffRef(begin + r, begin + c) = mass(r, c);
  }
}

void assemble_rows_transposed(const EquationsOfMotion& equations, SparseMatrix& B_transposed) {
  const System& system = equations.system();
  for (Index c = 0; c < B_transposed.cols(); ++c)
    for (SparseMatrix::InnerIterator each(B_transposed, c); each; ++each) each.valueRef() = 0;
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    const Index first = equations.solver().joint_offset(k);
    const auto add = [&](std::size_t body, const TransposedRows& rows) {
      if (body == JointPlace::kNoBody) return;
      for (Index c = 0; c < joint.rows; ++c)
        for (Index r = 0; r < rows.rows(); ++r)
          B_transposed.coeffRef(system.bodies[body].velocity + r, first + c) += rows(r, c);
    };
    add(system.places[k].body_i, joint.B_i);
    add(system.places[k].body_j, joint.B_j);
  }
}

ReducedDynamics::ReducedDynamics(EquationsOfMotion& equations, const VectorXd& positions,
                                 double time_s, TurningFrame frame)
    : equations_(equations),
      projection_(equations),
      origin_(positions),
      time_s_(time_s),
      frame_(std::move(frame)) {
  equations_.relax();
  equations_.set_positions(time_s_, origin_);
  if (origin_.size() == 0) return;
  // With M = L L^T the null space of B L^-T is the orthogonal complement in a QR of its transpose.
  const System& system = equations_.system();
  SparseMatrix mass(system.velocity_count, system.velocity_count);
  SparseMatrix all_rows(system.velocity_count, system.constraint_count);
  assemble_mass(equations_, mass);
  assemble_rows_transposed(equations_, all_rows);
  const MatrixXd M = mass;
  MatrixXd rows = MatrixXd(all_rows)(Eigen::all, independent(equations_));
  const Eigen::LLT<MatrixXd> cholesky(M);
  const Index free = M.rows() - rows.cols();
  N_ = MatrixXd::Zero(M.rows(), free);
  MN_ = N_;
  if (free == 0) return;
  N_.bottomRows(free).setIdentity();
  if (rows.cols() > 0) {
    cholesky.matrixL().solveInPlace(rows);
    N_.applyOnTheLeft(Eigen::ColPivHouseholderQR<MatrixXd>(rows).householderQ());
  }
  cholesky.matrixU().solveInPlace(N_);
  MN_ = M * N_;
}

double ReducedDynamics::extent(const VectorXd& xi) const {
  const System& system = equations_.system();
  const VectorXd change = N_ * xi;
  double extent = 0;
  for (const FreeBody& body : system.bodies) {
    const auto dQ = change.segment(body.velocity, body.constants.velocity_count());
    const double deformation =
        dQ.tail(body.constants.mode_count()).norm() / std::sqrt(body.constants.mass);
    extent = std::max({extent, dQ.head<3>().norm() / system.size_m, dQ.segment<3>(3).norm(),
                       deformation / system.size_m});
  }
  return extent;
}

VectorXd ReducedDynamics::positions_at(const VectorXd& xi) {
  VectorXd positions = origin_;
  equations_.system().retract(positions, N_ * xi);
  projection_.converge_positions(time_s_, positions);
  return positions;
}

ReducedDynamics ReducedDynamics::turned(double time_s) const {
  ReducedDynamics result = *this;
  const Vector3d angle = (time_s - time_s_) * frame_.rate_rad_s;
  const Matrix3d R = rotation_exp(angle);
  const Eigen::Quaterniond q = quaternion_exp(angle);
  for (const FreeBody& body : equations_.system().bodies) {
    auto place = result.origin_.segment<7>(body.position);
    place.head<3>() = frame_.point_m + R * (place.head<3>() - frame_.point_m);
    const Eigen::Quaterniond before(place[3], place[4], place[5], place[6]);
    const Eigen::Quaterniond after = q * before;
    place[3] = after.w();
    place.tail<3>() = after.vec();
    // Forces on and accelerations of the origin are in world axes, all else is in the body's.
    for (MatrixXd* each : {&result.N_, &result.MN_})
      each->middleRows<3>(body.velocity) = R * each->middleRows<3>(body.velocity);
  }
  result.time_s_ = time_s;
  return result;
}

VectorXd ReducedDynamics::carried_velocities() const {
  const System& system = equations_.system();
  VectorXd velocities = VectorXd::Zero(system.velocity_count);
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const BodyTerms& terms = equations_.body(b);
    auto V = velocities.segment<6>(system.bodies[b].velocity);
    V.head<3>() = frame_.rate_rad_s.cross(terms.x - frame_.point_m);
    V.tail<3>() = terms.A.transpose() * frame_.rate_rad_s;
  }
  return velocities;
}

VectorXd ReducedDynamics::solve(const VectorXd& velocities) {
  const System& system = equations_.system();
  const VectorXd carried = carried_velocities();
  equations_.set_velocities(carried + velocities);
  equations_.solve();
  VectorXd accelerations = equations_.accelerations();
  // x'' = x_rel'' + 2 Omega x x_rel' + Omega x (Omega x r), w' = w_rel' - w_rel x A^T Omega.
  const Vector3d& rate = frame_.rate_rad_s;
  for (const FreeBody& body : system.bodies) {
    const auto V = velocities.segment<6>(body.velocity);
    const auto frame_V = carried.segment<6>(body.velocity);
    const Vector3d v = V.head<3>();
    const Vector3d w = V.tail<3>();
    accelerations.segment<3>(body.velocity) -= rate.cross(2 * v + Vector3d(frame_V.head<3>()));
    accelerations.segment<3>(body.velocity + 3) += w.cross(Vector3d(frame_V.tail<3>()));
  }
  return MN_.transpose() * accelerations;
}

VectorXd ReducedDynamics::accelerations_at(const VectorXd& xi) {
  return accelerations_at(xi, VectorXd::Zero(count()));
}

VectorXd ReducedDynamics::accelerations_at(const VectorXd& xi, const VectorXd& rates) {
  equations_.set_positions(time_s_, positions_at(xi));
  return solve(N_ * rates);
}

MatrixXd ReducedDynamics::stiffness() {
  MatrixXd result(count(), count());
  kink_.clear();
  if (count() == 0) return result;
  const VectorXd there = rates_at(VectorXd::Zero(count()));
  for (Index i = 0; i < count(); ++i) {
    VectorXd xi = VectorXd::Unit(count(), i);
    const double step = kDifference / extent(xi);
    xi *= step;
    const RatesAndPieces ahead = state_at(xi);
    const RatesAndPieces behind = state_at(-xi);
    result.col(i) = (behind.rates - ahead.rates).head(count()) / (2 * step);
    if (kink_.empty()) kink_ = kink_between(equations_.forces(), ahead, there, behind);
  }
  return result;
}

MatrixXd ReducedDynamics::damping() {
  MatrixXd result(count(), count());
  equations_.set_positions(time_s_, origin_);
  for (Index i = 0; i < count(); ++i) {
    const double step = 1 / extent(VectorXd::Unit(count(), i));
    const VectorXd velocities = step * N_.col(i);
    result.col(i) = (solve(-velocities) - solve(velocities)) / (2 * step);
  }
  return result;
}

VectorXd ReducedDynamics::rates_at(const VectorXd& xi) {
  VectorXd rates(count() + equations_.system().internal_count);
  rates << accelerations_at(xi), equations_.forces().internal_rate();
  return rates;
}

RatesAndPieces ReducedDynamics::state_at(const VectorXd& xi) {
  RatesAndPieces result{rates_at(xi), equations_.forces().pieces(), {}};
  const std::vector<FreeBody>& bodies = equations_.system().bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (const ModalSprings& springs = bodies[b].constants.springs; springs.gaps.count() > 0)
      result.slits.emplace_back(bodies[b].name, springs, equations_.body(b).a);
  return result;
}

MatrixXd ReducedDynamics::state_matrix() {
  const Index k = count();
  const Index internal = equations_.system().internal_count;
  const VectorXd at_rest = VectorXd::Zero(k);
  VectorXd state = VectorXd::Zero(equations_.system().state_count());
  auto z = equations_.system().internal(state);
  if (internal > 0) {
    accelerations_at(at_rest);
    z = equations_.forces().internal();
    equations_.give_internal(state);
  }
  MatrixXd A = MatrixXd::Zero(2 * k + internal, 2 * k + internal);
  A.block(0, k, k, k).setIdentity();
  A.block(k, k, k, k) = -damping();
  kink_.clear();
  const VectorXd there = rates_at(at_rest);
  for (Index i = 0; i < k; ++i) {
    VectorXd xi = VectorXd::Unit(k, i);
    const double step = kDifference / extent(xi);
    xi *= step;
    const RatesAndPieces ahead = state_at(xi);
    const RatesAndPieces behind = state_at(-xi);
    A.block(k, 0, k + internal, k).col(i) = (ahead.rates - behind.rates) / (2 * step);
    if (kink_.empty()) kink_ = kink_between(equations_.forces(), ahead, there, behind);
  }
  // Loads are linear in the internal variables.
  for (Index i = 0; i < internal; ++i) {
    const double value = z[i];
    const auto rates_with = [&](double shift) {
      z[i] = value + shift;
      equations_.give_internal(state);
      return rates_at(at_rest);
    };
    A.col(2 * k + i).tail(k + internal) =
        (rates_with(kDifference) - rates_with(-kDifference)) / (2 * kDifference);
    z[i] = value;
  }
  equations_.relax();
  return A;
}

}  // namespace flexneck::multibody
