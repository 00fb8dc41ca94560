// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/section.h"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// sinc of half an angle, and its gradient over the rotation vector's part across the length.
struct ArcShortening {
  explicit ArcShortening(const Vector3d& across) {
    const RotationCoefficients k = rotation_coefficients(across.squaredNorm() / 4);
    ratio = k.a;
    gradient = (k.c - k.b) / 4 * across;
  }

  double ratio;
  Vector3d gradient;
};

Vector3d across(const Vector3d& theta, const Vector3d& length) {
  const double squared = length.squaredNorm();
  if (squared == 0) return Vector3d::Zero();
  return theta - (theta.dot(length) / squared) * length;
}

/// The least of an energy g^T A g / 2 + r^T g over g >= 0, A positive definite: of all ways to keep
/// some closed, the one in which nothing else would open or overlap.
class Gaps {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Section::kMaxGaps,
                               Section::kMaxGaps>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Section::kMaxGaps, 1>;

  Gaps(const Matrix& A, const Vector& r) : openings_m(Vector::Zero(r.size())) {
    double least = std::numeric_limits<double>::infinity();
    for (int open = 0; open < 1 << r.size(); ++open) {
      const Vector g = with_open(A, r, open);
      const Vector force = A * g + r;
      double violation = 0;  // as energy, so that openings and forces compare
      for (Eigen::Index k = 0; k < r.size(); ++k)
        violation = std::max(violation,
                             is_open(open, k)
                                 ? std::max(0.0, -g[k]) * std::max(0.0, -g[k]) * A(k, k)
                                 : std::max(0.0, -force[k]) * std::max(0.0, -force[k]) / A(k, k));
      if (violation >= least) continue;
      least = violation;
      openings_m = g.cwiseMax(0.0);
      which_open = open;
      if (violation == 0) return;  // there is but one least energy
    }
  }

  Vector openings_m;
  int which_open = 0;  ///< a bit each

 private:
  static bool is_open(int open, Eigen::Index gap) { return (open >> gap & 1) != 0; }
  static Vector with_open(Matrix A, Vector r, int open) {
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      if (is_open(open, k)) continue;
      A.row(k).setZero();
      A.col(k).setZero();
      A(k, k) = 1;
      r[k] = 0;
    }
    return -A.llt().solve(r);
  }
};

}  // namespace

void Section::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  if (!rest_m.allFinite()) refuse_force(who, "rest length is not finite");
  const Eigen::Index gaps = gap_count();
  if (gaps < 0 || gaps > kMaxGaps || stiffness.cols() != stiffness.rows())
    refuse_force(who, "stiffness must be square, of six motions and at most " +
                          std::to_string(kMaxGaps) + " gaps");
  check_stiffness(who, "stiffness", stiffness);
  const auto diagonal = stiffness.bottomRightCorner(gaps, gaps);
  if (gaps > 0 && Eigen::MatrixXd(diagonal).llt().info() != Eigen::Success)
    refuse_force(who, "stiffness of the gaps must be positive");
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const std::string which = "branch " + std::to_string(k + 1);
    if (branches[k].stiffness.rows() != stiffness.rows())
      refuse_force(who, "stiffness of " + which + " must be of the same size");
    check_stiffness(who, "stiffness of " + which, branches[k].stiffness);
    if (!(branches[k].relaxation_time_s > 0 && std::isfinite(branches[k].relaxation_time_s)))
      refuse_force(who, "relaxation time of " + which + " must be positive");
  }
}

Section::Strain Section::with_gaps(const Vector6d& e, const InternalVariables& internal,
                                   int& which_open) const {
  const Eigen::Index gaps = gap_count();
  Strain strain = Strain::Zero(6 + gaps);
  strain.head<6>() = e;
  if (gaps == 0) return strain;
  Gaps::Matrix A = stiffness.bottomRightCorner(gaps, gaps);
  Gaps::Vector r = stiffness.bottomRows(gaps) * strain;
  InternalVariables of_branch = internal;
  for (const Branch& branch : branches) {
    const Branch::SpringStrain spring = branch.spring(of_branch);
    A += spring.share * branch.stiffness.bottomRightCorner(gaps, gaps);
    r += branch.stiffness.bottomRows(gaps) * spring.of(strain);
    of_branch = of_branch.behind(branch_size());
  }
  const Gaps found(A, r);
  strain.tail(gaps) = found.openings_m;
  which_open = found.which_open;
  return strain;
}

void Section::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const Matrix3d& R_i = input.i.R;
  const Vector3d theta = rotation_log(R_i.transpose() * input.j.R);
  const Matrix3d half = rotation_exp(theta / 2);
  const Matrix3d R_mid = R_i * half;
  const Vector3d d = R_mid.transpose() * (input.j.p - input.i.p);
  const ArcShortening arc(across(theta, rest_m));

  Vector6d e;
  e << d - arc.ratio * rest_m + theta.cross(rest_m) / 2, theta;
  load.piece = {};
  const Strain strain = with_gaps(e, input.internal, load.piece.deflection);
  Strain stress = stiffness * strain;
  sums.stored_J += strain.dot(stress) / 2;
  InternalVariables internal = input.internal;
  for (const Branch& branch : branches) {
    const Strain spring = branch.spring(internal).of(strain);
    const Strain part = branch.stiffness * spring;
    stress += part;
    sums.stored_J += spring.dot(part) / 2;
    sums.lost_W += spring.dot(part) / branch.relaxation_time_s;
    branch.answer(strain, spring, internal);
    internal = internal.behind(branch_size());
  }

  // Virtual work (equations.md section 8): of w and theta, then of the motion of j against i.
  const Vector3d f = stress.head<3>();
  const Vector3d m = stress.segment<3>(3) + rest_m.cross(f) / 2 - f.dot(rest_m) * arc.gradient;
  const Vector3d turning = half * f.cross(d);
  const Matrix3d J = left_jacobian(theta);
  const Vector3d moment =
      J.transpose().inverse() * (left_jacobian(theta / 2).transpose() * turning / 2 + m);
  load.force_N = -(R_mid * f);
  load.moment_Nm = -(R_i * moment);
}

}  // namespace flexneck::multibody
