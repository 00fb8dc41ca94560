// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Searches for the first kink of a load inside a step, also if a piece of a law is entered and
/// left again within it. The coordinates of the laws at a few points of the motion bound their
/// deviation from the chord between the step's ends; only if that bound reaches a kink, the step's
/// dense output is evaluated, by repeated halving. Allocates on construction alone.
class EventSearch {
 public:
  /// Evaluates the loads at a fraction of the step.
  using Evaluate = std::function<void(double share)>;

  /// @param forces  all calls use its last evaluation; must outlive this
  explicit EventSearch(const ForceSet& forces);

  bool is_idle() const { return forces_.pieces().empty(); }
  /// Starts at the beginning of a step after a jump.
  void start();
  /// Begins another try of the step from the last start() or accept().
  void begin_step() { seen_ = 0; }
  /// Records a point inside the step.
  void see(double share) { see(share, forces_.kinks()); }
  /// Records the beginning of the step before, if there was one since start().
  /// @param share  its position as a fraction of the step: below zero
  void see_step_before(double share);
  void see_end() { end_.take(forces_); }
  /// Returns whether the end is on another piece than the beginning.
  bool is_left() const { return begin_.pieces != end_.pieces; }
  /// The fraction of the step at which the first piece of a law is left; 1 if none before the end.
  /// If no point has been recorded, the middle is evaluated.
  double first_event(const Evaluate& evaluate);
  /// The piece that is left there, as an index among all.
  std::size_t event() const { return event_; }
  /// Number of evaluations of the loads in the last first_event().
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
  /// Interval between two points of a step.
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
  std::vector<Sample> middles_;              ///< midpoints of the spans at each level
  std::vector<std::vector<double>> swings_;  ///< bounds of deviations from their chords
  std::size_t event_ = 0;
  int evaluations_ = 0;
};

}  // namespace flexneck::multibody
