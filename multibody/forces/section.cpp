// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/section.h"

#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "multibody/forces/arc.h"
#include "multibody/forces/least_gaps.h"
#include "multibody/forces/sliding_slit.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Bending whose moment and energy over the angle follow a curve: a section bent by an angle t has
/// the energy of a linear one bent by f(t), where f^2 / 2 is the curve's energy over its first
/// slope. Zero rotation stays zero.
class CurvedBending {
 public:
  CurvedBending(const LoadCurve& curve, const Vector3d& bending) {
    const double first_slope = curve.first_slope();
    angle_ = bending.norm();
    piece = curve.piece(angle_);
    if (!(angle_ > kStraight)) return;
    const double f = std::sqrt(2 * curve.energy(angle_) / first_slope);
    ratio_ = f / angle_;
    slope_ = curve.value(angle_) / (first_slope * f);
    along_ = bending / angle_;
  }

  /// Bending on which the stiffness acts, less the actual bending.
  Vector3d added_to(const Vector3d& bending) const { return (ratio_ - 1) * bending; }
  /// Moment conjugate to the actual bending, computed from that conjugate to the bending on which
  /// the stiffness acts, less the latter; both transverse to the length.
  Vector3d added_to_moment(const Vector3d& moment) const {
    const double along = along_.dot(moment);
    return (ratio_ - 1) * (moment - along * along_) + (slope_ - 1) * along * along_;
  }

  CurvePiece piece;
  /// Kinks along the bending angle, which has none at zero.
  KinksAround kinks() const {
    KinksAround found{angle_};
    if (piece.low > 0) found.low = piece.low;
    found.high = piece.high;
    return found;
  }

 private:
  static constexpr double kStraight = 1e-9;  // rad: the curve's first row is further
  double angle_ = 0;
  double ratio_ = 1, slope_ = 1;
  Vector3d along_ = Vector3d::Zero();
};

/// A section whose number of gaps is known at compile time, so that its small vectors stay in
/// registers: sections take much of the time of a neck of plates.
template <int kGaps>
class Sized {
 public:
  static constexpr int kSize = 6 + kGaps;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  explicit Sized(const Section& section) : section_(section) {}

  Vector with_gaps(const Vector6d& e, [[maybe_unused]] InternalVariables internal,
                   [[maybe_unused]] LawPiece& piece) const {
    Vector strain = Vector::Zero();
    strain.template head<6>() = e;
    if constexpr (kGaps > 0) {
      using Gaps = LeastGaps<kGaps>;
      const auto K = map(section_.stiffness);
      typename Gaps::Matrix A = K.template bottomRightCorner<kGaps, kGaps>();
      typename Gaps::Vector r = K.template bottomLeftCorner<kGaps, 6>().lazyProduct(e);
      for (const Section::Branch& branch : section_.branches) {
        const auto spring = branch.spring<Vector>(internal);
        const auto K_branch = map(branch.stiffness);
        A += spring.share * K_branch.template bottomRightCorner<kGaps, kGaps>();
        const Vector offset = spring.of(strain);
        r += K_branch.template bottomRows<kGaps>().lazyProduct(offset);
        internal = internal.behind(kSize);
      }
      const Gaps found(A, r, piece.deflection);
      strain.template tail<kGaps>() = found.openings_m;
      piece.deflection = found.which_open;
      piece.of_deflection = {found.to_next_m, 0};
    }
    return strain;
  }

  /// Loads for the motion e; also sets internal variables and energies.
  Vector6d stress(const Vector6d& e, InternalVariables internal, LawPiece& piece,
                  ForceEnergies& sums) const {
    const Vector strain = with_gaps(e, internal, piece);
    Vector sum = map(section_.stiffness).lazyProduct(strain);
    sums.stored_J += strain.dot(sum) / 2;
    for (const Section::Branch& branch : section_.branches) {
      const Vector spring = branch.spring<Vector>(internal).of(strain);
      const Vector part = map(branch.stiffness).lazyProduct(spring);
      sum += part;
      const double energy_J = spring.dot(part) / 2;
      sums.stored_J += energy_J;
      sums.lost_W += 2 * energy_J / branch.relaxation_time_s;
      branch.answer(strain, spring, internal);
      internal = internal.behind(kSize);
    }
    return sum.template head<6>();
  }

 private:
  static Eigen::Map<const Eigen::Matrix<double, kSize, kSize>> map(
      const Section::Stiffness& matrix) {
    return Eigen::Map<const Eigen::Matrix<double, kSize, kSize>>(matrix.data());
  }

  const Section& section_;
};

/// Calls `work` with the section, its number of gaps known at compile time.
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

/// Loads as Sized::stress(), with friction in the slit.
Vector6d stress_with_friction(const Section& section, const Vector6d& e, InternalVariables internal,
                              LawPiece& piece, ForceEnergies& sums) {
  const SlidingSlit slit = sliding_slit(section, e, internal, piece.deflection);
  Section::Strain sum = section.stiffness * slit.strain;
  sums.stored_J += slit.strain.dot(sum) / 2;
  for (const Section::Branch& branch : section.branches) {
    const Section::Strain spring = branch.spring<Section::Strain>(internal).of(slit.strain);
    const Section::Strain part = branch.stiffness * spring;
    sum += part;
    sums.stored_J += spring.dot(part) / 2;
    sums.lost_W += spring.dot(part) / branch.relaxation_time_s;
    branch.answer(slit.strain, spring, internal);
    internal = internal.behind(section.branch_size());
  }
  sums.lost_W += slit.lost_W;
  if (internal.found_values != nullptr) {
    using Map = Eigen::Map<Section::Strain>;
    Map slides(internal.found_values, section.branch_size());
    slides = slit.strain;
    slides.head(section.branch_size() - section.friction.slides).setZero();
    Map(internal.found_rates, section.branch_size()) = slit.rate;
  }
  piece.deflection = slit.which_open;
  piece.rate = slit.slips ? 1 : 0;
  return sum.head<6>();
}

void check_friction(const std::string& who, const Section& section) {
  const SlitFriction& friction = section.friction;
  if (friction.slides == 0) return;
  if (friction.slides < 0 || friction.slides > Section::kMaxSlides)
    refuse_force(who, "the sides of a slit can slide in at most " +
                          std::to_string(Section::kMaxSlides) + " ways, found " +
                          std::to_string(friction.slides));
  if (section.gap_count() < 1 || section.gap_count() > Section::kMaxGapsOfSlit)
    refuse_force(who, "friction needs a single slit with one or two gaps");
  if (!(friction.coefficient >= 0 && std::isfinite(friction.coefficient)))
    refuse_force(who, "coefficient of friction must not be negative");
  if (!(friction.sliding_time_s > 0 && std::isfinite(friction.sliding_time_s)))
    refuse_force(who, "sliding time must be positive");
}

}  // namespace

void Section::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  if (!rest_m.allFinite()) refuse_force(who, "rest length is not finite");
  check_friction(who, *this);
  const Eigen::Index gaps = gap_count();
  if (gaps < 0 || gaps > kMaxGaps || stiffness.cols() != stiffness.rows())
    refuse_force(who, "stiffness must be a square matrix for six motions and at most " +
                          std::to_string(kMaxGaps) + " gaps");
  check_stiffness(who, "stiffness", stiffness);
  const Eigen::Index inner = gaps + friction.slides;
  const auto diagonal = stiffness.bottomRightCorner(inner, inner);
  if (gaps > 0 && Eigen::MatrixXd(diagonal).llt().info() != Eigen::Success)
    refuse_force(who, "stiffness of the gaps and of the sliding motions must be positive definite");
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const std::string which = "branch " + std::to_string(k + 1);
    if (branches[k].stiffness.rows() != stiffness.rows())
      refuse_force(who, "stiffness of " + which + " must be of the same size");
    check_stiffness(who, "stiffness of " + which, branches[k].stiffness);
    if (!(branches[k].relaxation_time_s > 0 && std::isfinite(branches[k].relaxation_time_s)))
      refuse_force(who, "relaxation time of " + which + " must be positive");
  }
  if (bending_curve.is_none()) return;
  if (rest_m.isZero(0)) refuse_force(who, "a bending curve needs a section with a length");
  if (!(bending_curve.first_slope() > 0) || bending_curve.falls())
    refuse_force(who, "the bending curve must have a positive initial slope and never fall");
}

Section::Strain Section::with_gaps(const Vector6d& e, const InternalVariables& internal,
                                   int& which_open) const {
  LawPiece piece;
  piece.deflection = which_open;
  const Strain strain =
      sized(*this, [&](const auto& of) { return Strain(of.with_gaps(e, internal, piece)); });
  which_open = piece.deflection;
  return strain;
}

void Section::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const Matrix3d& R_i = input.i.R;
  const Vector3d theta = rotation_log(R_i.transpose() * input.j.R);
  const HalfTurn half(theta);
  const Vector3d d = half.turned_back(R_i.transpose() * (input.j.p - input.i.p));
  const Vector3d bending = part_across(theta, rest_m);
  const ArcShortening arc(bending);

  Vector6d e;
  e << d - arc.ratio * rest_m + theta.cross(rest_m) / 2, theta;
  std::optional<CurvedBending> curved;
  if (!bending_curve.is_none()) {
    curved.emplace(bending_curve, bending);
    const Vector3d added = curved->added_to(bending);
    e.tail<3>() += added;
    e.head<3>() += added.cross(rest_m) / 2;
  }
  const Vector6d stress = has_friction()
                              ? stress_with_friction(*this, e, input.internal, load.piece, sums)
                              : sized(*this, [&](const auto& of) {
                                  return of.stress(e, input.internal, load.piece, sums);
                                });
  load.piece.rate =
      2 * (curved ? curved->piece.number : 0) + (has_friction() ? load.piece.rate : 0);
  if (curved) load.piece.of_rate = curved->kinks();

  // Virtual work (equations.md section 8): first of w and theta, then of the motion of j relative
  // to i.
  const Vector3d f = stress.head<3>();
  Vector3d m = stress.tail<3>() + rest_m.cross(f) / 2;
  if (curved) m += curved->added_to_moment(part_across(m, rest_m));
  m -= f.dot(rest_m) * arc.gradient;
  const Vector3d turning = half.turned(f.cross(d));
  load.force_N = -(R_i * half.turned(f));
  load.moment_Nm = -(R_i * half.to_moment(half.of_rate(turning) / 2 + m));
}

}  // namespace flexneck::multibody
