// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/section.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "multibody/forces/arc.h"
#include "multibody/forces/least_gaps.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A section whose number of gaps the compiler knows, so that its small vectors stay in registers:
/// sections are much of the work of a neck of plates.
template <int kGaps>
class Sized {
 public:
  static constexpr int kSize = 6 + kGaps;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  explicit Sized(const Section& section) : section_(section) {}

  Vector with_gaps(const Vector6d& e, [[maybe_unused]] InternalVariables internal,
                   [[maybe_unused]] int& which_open) const {
    Vector strain = Vector::Zero();
    strain.template head<6>() = e;
    if constexpr (kGaps > 0) {
      using Gaps = LeastGaps<kGaps>;
      const auto K = map(section_.stiffness);
      typename Gaps::Matrix A = K.template bottomRightCorner<kGaps, kGaps>();
      typename Gaps::Vector r = K.template bottomLeftCorner<kGaps, 6>().lazyProduct(e);
      for (const Section::Branch& branch : section_.branches) {
        const auto spring = branch.spring(internal);
        const auto K_branch = map(branch.stiffness);
        A += spring.share * K_branch.template bottomRightCorner<kGaps, kGaps>();
        r += K_branch.template bottomRows<kGaps>().lazyProduct(strain_of(spring, strain));
        internal = internal.behind(kSize);
      }
      const Gaps found(A, r, which_open);
      strain.template tail<kGaps>() = found.openings_m;
      which_open = found.which_open;
    }
    return strain;
  }

  /// Loads that go with the motion e; internal variables and energies besides.
  Vector6d stress(const Vector6d& e, InternalVariables internal, int& which_open,
                  ForceEnergies& sums) const {
    const Vector strain = with_gaps(e, internal, which_open);
    Vector sum = map(section_.stiffness).lazyProduct(strain);
    sums.stored_J += strain.dot(sum) / 2;
    for (const Section::Branch& branch : section_.branches) {
      const Vector spring = strain_of(branch.spring(internal), strain);
      const Vector part = map(branch.stiffness).lazyProduct(spring);
      sum += part;
      const double energy_J = spring.dot(part) / 2;
      sums.stored_J += energy_J;
      sums.lost_W += 2 * energy_J / branch.relaxation_time_s;
      branch.answer(Section::Strain(strain), Section::Strain(spring), internal);
      internal = internal.behind(kSize);
    }
    return sum.template head<6>();
  }

 private:
  static Vector strain_of(const Section::Branch::SpringStrain& spring, const Vector& strain) {
    return spring.share * strain + Eigen::Map<const Vector>(spring.offset.data());
  }
  static Eigen::Map<const Eigen::Matrix<double, kSize, kSize>> map(
      const Section::Stiffness& matrix) {
    return Eigen::Map<const Eigen::Matrix<double, kSize, kSize>>(matrix.data());
  }

  const Section& section_;
};

/// Does work with the section, its number of gaps known.
template <class Work>
auto sized(const Section& section, const Work& work) {
  static_assert(Section::kMaxGaps == 4);
  switch (section.gap_count()) {
    case 1:
      return work(Sized<1>(section));
    case 2:
      return work(Sized<2>(section));
    case 3:
      return work(Sized<3>(section));
    case 4:
      return work(Sized<4>(section));
    default:
      return work(Sized<0>(section));
  }
}

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
  return sized(*this,
               [&](const auto& of) { return Strain(of.with_gaps(e, internal, which_open)); });
}

void Section::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const Matrix3d& R_i = input.i.R;
  const Vector3d theta = rotation_log(R_i.transpose() * input.j.R);
  const HalfTurn half(theta);
  const Vector3d d = half.turned_back(R_i.transpose() * (input.j.p - input.i.p));
  const ArcShortening arc(part_across(theta, rest_m));

  Vector6d e;
  e << d - arc.ratio * rest_m + theta.cross(rest_m) / 2, theta;
  int which_open = load.piece.deflection;
  const Vector6d stress =
      sized(*this, [&](const auto& of) { return of.stress(e, input.internal, which_open, sums); });
  load.piece = {which_open, 0};

  // Virtual work (equations.md section 8): of w and theta, then of the motion of j against i.
  const Vector3d f = stress.head<3>();
  const Vector3d m = stress.tail<3>() + rest_m.cross(f) / 2 - f.dot(rest_m) * arc.gradient;
  const Vector3d turning = half.turned(f.cross(d));
  load.force_N = -(R_i * half.turned(f));
  load.moment_Nm = -(R_i * half.to_moment(half.of_rate(turning) / 2 + m));
}

}  // namespace flexneck::multibody
