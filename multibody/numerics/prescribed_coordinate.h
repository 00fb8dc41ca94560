// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/numerics/smooth_motion.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::multibody {

/// A coordinate given over time, in m or rad: the sum of an initial rate, a table of accelerations
/// and a function of time. Exact, by the integrals of the table and of the function; by default
/// zero.
class PrescribedCoordinate {
 public:
  PrescribedCoordinate() = default;
  PrescribedCoordinate(double initial_rate, const TimeTable& accelerations,
                       const SmoothMotion& function);

  bool moves() const { return moves_; }
  double value(double time_s) const;
  double rate(double time_s) const;
  double second_rate(double time_s) const;

  /// Times at which the second rate or its slope may jump.
  void add_breakpoints(std::vector<double>& times_s) const;

 private:
  bool moves_ = false;
  double value_before_ = 0, rate_before_ = 0;  ///< what the table alone would have at time zero
  TimeTable table_;
  SmoothMotion function_;
};

}  // namespace flexneck::multibody
