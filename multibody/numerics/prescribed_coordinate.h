// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/numerics/smooth_motion.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::multibody {

/// Part of a coordinate that an input gives: its second rate, constant from a time on, m/s^2 or
/// rad/s^2, with its value and rate at that time, m or rad.
struct HeldInput {
  double since_s = 0;
  double value = 0;
  double rate = 0;
  double second_rate = 0;

  bool is_none() const { return value == 0 && rate == 0 && second_rate == 0; }
  double value_at(double time_s) const {
    const double passed = time_s - since_s;
    return value + passed * (rate + 0.5 * passed * second_rate);
  }
  double rate_at(double time_s) const { return rate + (time_s - since_s) * second_rate; }
};

/// A prescribed coordinate, in m or rad: the sum of an initial rate, a table of accelerations, a
/// function of time and the part of an input. Exact, by the integrals of the table and of the
/// function; by default zero.
class PrescribedCoordinate {
 public:
  PrescribedCoordinate() = default;
  PrescribedCoordinate(double initial_rate, const TimeTable& accelerations,
                       const SmoothMotion& function, const HeldInput& input = {});

  bool moves() const { return moves_ || !input_.is_none(); }
  const SmoothMotion& function() const { return function_; }
  const HeldInput& input() const { return input_; }
  void set_input(const HeldInput& input) { input_ = input; }
  double value(double time_s) const;
  double rate(double time_s) const;
  double second_rate(double time_s) const;

  /// Times at which the second rate or its slope may jump.
  void add_breakpoints(std::vector<double>& times_s) const;

  /// Serialises its fields (geometry/foundation/byte_archive.h).
  template <class Archive>
  void archive(Archive& all) {
    all(moves_, value_before_, rate_before_, table_, function_, input_);
  }

 private:
  bool moves_ = false;
  double value_before_ = 0, rate_before_ = 0;  ///< value and rate of the table alone at time zero
  TimeTable table_;
  SmoothMotion function_;
  HeldInput input_;
};

}  // namespace flexneck::multibody
