// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace flexneck::multibody {

/// A piecewise linear function of time, with its exact first and second integrals.
class TimeTable {
 public:
  /// Values before the first and after the last time.
  enum class Outside { zero, constant };

  TimeTable() = default;  ///< zero everywhere
  /// A table with times in s, strictly increasing.
  /// @throws InputError otherwise, or for values that are not finite.
  TimeTable(std::vector<double> times_s, std::vector<double> values, Outside outside);

  /// The value at a time. At the first and the last time it is that of the table, even if the
  /// function jumps to zero outside.
  double value(double time_s) const;
  double integral(double time_s) const;         ///< from the first time on; zero before it
  double second_integral(double time_s) const;  ///< integral of integral()

  /// Times of kinks and jumps: the integrator steps onto these times.
  const std::vector<double>& times_s() const { return times_s_; }

  /// Serialises its fields (geometry/foundation/byte_archive.h).
  template <class Archive>
  void archive(Archive& all) {
    all(times_s_, values_, integrals_, second_integrals_, outside_);
  }

 private:
  /// The linear piece at a time from the first on: the row at which it starts, its value there and
  /// its slope.
  struct Segment {
    std::size_t start;
    double value;
    double slope;
  };
  Segment segment(double time_s) const;

  std::vector<double> times_s_;
  std::vector<double> values_;
  std::vector<double> integrals_;
  std::vector<double> second_integrals_;
  Outside outside_ = Outside::zero;
};

}  // namespace flexneck::multibody
