// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/sliding_slit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "multibody/forces/least_gaps.h"

namespace flexneck::multibody {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
constexpr int kSlides = Section::kMaxSlides;
using Slides = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kSlides, 1>;

/// Loads H x + c of the coordinates x = [e; g; s] at a motion e. For a mobility m, m/N, gaps and s
/// minimise one energy, that of the loads plus |s - s_0|^2 / (2 m): the sides stick at m = 0 and
/// are frictionless at infinity.
template <int kGaps>
class Slit {
 public:
  Slit(const Section& section, const Vector6d& e, InternalVariables internal, int tried_first)
      : count_(section.friction.slides),
        friction_(section.friction),
        H_(section.stiffness),
        load_(Section::Strain::Zero(section.branch_size())),
        stiffness_(H_.diagonal().tail(count_).mean()),
        which_open_(tried_first) {
    for (const Section::Branch& branch : section.branches) {
      const auto spring = branch.spring<Section::Strain>(internal);
      H_ += spring.share * branch.stiffness;
      load_ += branch.stiffness * spring.offset;
      stiffness_ += branch.stiffness.diagonal().tail(count_).mean();
      internal = internal.behind(section.branch_size());
    }
    load_ += H_.leftCols<6>() * e;
    internal_ = internal;
  }

  SlidingSlit solve(const Vector6d& e) {
    double left = 0;
    if (internal_.known == InternalVariables::Known::relaxed) {
      move(std::numeric_limits<double>::infinity());
    } else {
      begin_m_ = Eigen::Map<const Section::Strain>(internal_.values, H_.rows()).tail(count_);
      left = left_at(0);
      if (internal_.known == InternalVariables::Known::begin && left > 0) left = left_over_step();
    }
    SlidingSlit found{load_, Section::Strain::Zero(load_.size()), 0, which_open_, left > 0};
    found.strain << e, openings_m_, slides_m_;
    found.rate.tail(count_) = left / (friction_.sliding_time_s * stiffness_) * force_N_;
    found.lost_W = found.rate.tail(count_).dot(force_N_);
    return found;
  }

 private:
  using Gaps = LeastGaps<kGaps>;

  void move(double mobility) {
    using Coupling = Eigen::Matrix<double, Eigen::Dynamic, kGaps, 0, kSlides, kGaps>;
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kSlides, kSlides>;
    const Square ss = H_.bottomRightCorner(count_, count_);
    const Coupling sg = H_.block(6 + kGaps, 6, count_, kGaps);
    const Slides load = load_.tail(count_);
    slides_m_ = begin_m_;
    Coupling follow = Coupling::Zero(count_, kGaps);
    if (mobility > 0) {
      Square held = ss;
      held.diagonal().array() += 1 / mobility;
      const Eigen::LLT<Square> factor(held);
      slides_m_ = factor.solve(begin_m_ / mobility - load);
      follow = -factor.solve(sg);
    }
    const typename Gaps::Matrix A = H_.template block<kGaps, kGaps>(6, 6) + sg.transpose() * follow;
    const typename Gaps::Vector r = load_.template segment<kGaps>(6) + sg.transpose() * slides_m_;
    const Gaps found(A, r, which_open_);
    which_open_ = found.which_open;
    openings_m_ = found.openings_m;
    slides_m_ += follow * openings_m_;
    force_N_ = -(load + sg * openings_m_ + ss * slides_m_);
    const typename Gaps::Vector pressing = A * openings_m_ + r;
    normal_N_ = 0;
    for (int k = 0; k < kGaps; ++k)
      if ((which_open_ >> k & 1) == 0) normal_N_ += std::max(0.0, pressing[k]);
  }

  /// Fraction of the force that friction leaves after a move, 1 - mu N / |F|; 0 if the sides stick.
  double left_at(double mobility) {
    move(mobility);
    const double pull_N = force_N_.norm();
    const double most_N = friction_.coefficient * normal_N_;
    return pull_N > most_N ? 1 - most_N / pull_N : 0;
  }

  /// Fraction x of the free sides' mobility at which friction leaves the same fraction x of the
  /// force, between sticking, which leaves more, and free, which cannot leave more than all, by
  /// false position (Illinois).
  double left_over_step() {
    constexpr int kMost = 100;
    constexpr double kSame = 1e-14;
    const auto [decay, share] = *internal_.steps;
    const double free = (1 - decay) / share / stiffness_;
    double low = 0;
    double high = 1;
    double at_low = -left_at(0);
    double at_high = 1 - left_at(free);
    double x = 1;
    double last = at_high;
    for (int k = 0; k < kMost && std::abs(last) > kSame && high - low > kSame; ++k) {
      x = low - at_low * (high - low) / (at_high - at_low);
      const double before = last;
      last = x - left_at(x * free);
      if (last < 0) {
        low = x;
        at_low = last;
        if (before < 0) at_high /= 2;
      } else {
        high = x;
        at_high = last;
        if (before >= 0) at_low /= 2;
      }
    }
    return x;
  }

  Eigen::Index count_;
  const SlitFriction& friction_;
  Section::Stiffness H_;  ///< with the branches' part, over a step
  Section::Strain load_;  ///< at g = s = 0
  Slides begin_m_ = Slides::Zero(count_);
  Slides slides_m_, force_N_;
  double stiffness_;  ///< mean stiffness of s for fast motions, N/m
  Eigen::Matrix<double, kGaps, 1> openings_m_;
  double normal_N_ = 0;
  InternalVariables internal_;
  int which_open_;
};

}  // namespace

SlidingSlit sliding_slit(const Section& section, const Vector6d& e,
                         const InternalVariables& internal, int tried_first) {
  return section.gap_count() == 1 ? Slit<1>(section, e, internal, tried_first).solve(e)
                                  : Slit<2>(section, e, internal, tried_first).solve(e);
}

}  // namespace flexneck::multibody
