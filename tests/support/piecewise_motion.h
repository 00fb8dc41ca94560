// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace flexneck::testing {

/// A coordinate x under a constant acceleration and springs that act only beyond or below a
/// position, in closed form: parabolas and sinusoids from one such position to the next.
class PiecewiseMotion {
 public:
  struct Spring {
    double from;       ///< acts where (x - from) side > 0
    int side;          ///< 1 or -1
    double stiffness;  ///< over the mass, 1/s^2
  };

  PiecewiseMotion(double acceleration, std::vector<Spring> springs, double x, double v)
      : acceleration_(acceleration), springs_(std::move(springs)), x_(x), v_(v) {}

  double x() const { return x_; }
  double v() const { return v_; }
  int kinks() const { return kinks_; }

  void advance(double time) {
    while (time > 0) {
      const double step = std::min(time, time_to_kink());
      if (step < time) ++kinks_;
      move(step);
      time -= step;
    }
  }

 private:
  /// Sets x'' = a - k (x - c) for the present piece, by the direction of x.
  void look() {
    k_ = 0;
    pull_ = acceleration_;
    for (const Spring& spring : springs_) {
      const double beyond = (x_ - spring.from) * spring.side;
      const bool is_on_it = std::abs(beyond) < 1e-12 * std::max(1.0, std::abs(spring.from));
      if (is_on_it ? v_ * spring.side > 0 : beyond > 0) {
        k_ += spring.stiffness;
        pull_ += spring.stiffness * spring.from;
      }
    }
  }
  double time_to_kink() {
    look();
    double first = std::numeric_limits<double>::infinity();
    for (const Spring& spring : springs_) first = std::min(first, time_to(spring.from));
    return first;
  }
  double time_to(double place) const {
    constexpr double kNow = 1e-11;
    double first = std::numeric_limits<double>::infinity();
    const auto consider = [&](double time) {
      if (time > kNow) first = std::min(first, time);
    };
    if (k_ == 0) {
      const double a = pull_ / 2;
      const double root = v_ * v_ - 4 * a * (x_ - place);
      if (a == 0) {
        consider((place - x_) / v_);
      } else if (root >= 0) {
        consider((-v_ + std::sqrt(root)) / (2 * a));
        consider((-v_ - std::sqrt(root)) / (2 * a));
      }
      return first;
    }
    const double omega = std::sqrt(k_);
    const double center = pull_ / k_;
    const double radius = std::hypot(x_ - center, v_ / omega);
    if (std::abs(place - center) > radius) return first;
    const double phase = std::atan2(v_ / omega, x_ - center);
    const double angle = std::acos((place - center) / radius);
    for (const double sign : {-1.0, 1.0})
      for (int turn = -1; turn <= 2; ++turn)
        consider((phase + sign * angle + 2 * std::numbers::pi * turn) / omega);
    return first;
  }
  void move(double time) {
    if (k_ == 0) {
      x_ += time * (v_ + time * pull_ / 2);
      v_ += time * pull_;
      return;
    }
    const double omega = std::sqrt(k_);
    const double from_center = x_ - pull_ / k_;
    const double c = std::cos(omega * time);
    const double s = std::sin(omega * time);
    const double v = v_ * c - omega * from_center * s;
    x_ += from_center * (c - 1) + v_ / omega * s;
    v_ = v;
  }

  double acceleration_;
  std::vector<Spring> springs_;
  double x_, v_;
  double k_ = 0, pull_ = 0;
  int kinks_ = 0;
};

}  // namespace flexneck::testing
