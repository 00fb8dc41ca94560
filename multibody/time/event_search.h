// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Looks for the first kink of a load inside of a step, also where a piece of a law is entered and
/// left again within it. The coordinates of the laws at a few points of the motion bound how far
/// they may swing beyond the ends of the step; only where that reaches a kink, the step's dense
/// output is evaluated, at halves of halves. Allocates on construction alone.
class EventSearch {
 public:
  /// Evaluates the loads at a share of the step.
  using Evaluate = std::function<void(double share)>;

  /// @param forces  which all calls refer to as they were evaluated last; must outlive this
  explicit EventSearch(const ForceSet& forces);

  bool is_idle() const { return forces_.pieces().empty(); }
  /// At the beginning of a step, behind a jump.
  void start();
  /// The next step is tried, from where start() or the last accept() was.
  void begin_step() { seen_ = 0; }
  /// At a point inside of the step.
  void see(double share) { see(share, forces_.kinks()); }
  /// The beginning of the step before, if there was one since start().
  /// @param share  at which it lies: below zero
  void see_step_before(double share);
  void see_end() { end_.take(forces_); }
  /// Tells whether the end is on another piece than the beginning.
  bool is_left() const { return begin_.pieces != end_.pieces; }
  /// The share of the step at which the first piece of a law is left; 1 if none is before the end.
  /// A point must have been seen, or the middle is.
  double first_event(const Evaluate& evaluate);
  /// The piece that is left there, an index among all.
  std::size_t event() const { return event_; }
  /// How often first_event() evaluated the loads, last.
  int evaluations() const { return evaluations_; }
  void accept();

 private:
  static constexpr int kMaxLevel = 30;  ///< halvings: to 1e-9 of a step
  static constexpr std::size_t kMaxPoints = 4;

  struct Sample {
    std::vector<int> pieces;
    std::vector<KinksAround> kinks;
    void take(const ForceSet& forces) {
      pieces = forces.pieces();
      kinks = forces.kinks();
    }
  };
  struct Point {
    double share = 0;
    std::vector<KinksAround> kinks;
  };
  /// From one point of a step to another.
  struct Span {
    double begin;
    const Sample& at_begin;
    double end;
    const Sample& at_end;
  };

  void see(double share, const std::vector<KinksAround>& kinks);
  void bound_by_points();
  bool may_leave(const Span& span, int level) const;
  double first_departure(const Span& span, int level, const Evaluate& evaluate);

  const ForceSet& forces_;
  Sample before_, begin_, end_;
  bool has_before_ = false;
  std::array<Point, kMaxPoints> points_;
  std::size_t seen_ = 0;
  std::vector<Sample> middles_;              ///< of the spans at each level
  std::vector<std::vector<double>> swings_;  ///< there, how far coordinates may leave their chord
  std::size_t event_ = 0;
  int evaluations_ = 0;
};

}  // namespace flexneck::multibody
