// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "geometry/foundation/progress.h"

namespace flexneck::pipeline {

/// Text such as "3 h 12 min" or "45 s".
std::string duration_text(double seconds);

/// Reports every few seconds the number of finished things and the remaining time.
class Countdown {
 public:
  /// @param things  name of the things, such as "rows"
  /// @param tell    may be empty; outlives this
  Countdown(std::uint64_t due, std::string things, const Progress& tell);

  void count(bool has_failed);

 private:
  using Clock = std::chrono::steady_clock;

  std::uint64_t due_;
  std::string things_;
  const Progress& tell_;
  std::uint64_t done_ = 0;
  std::uint64_t failed_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point told_ = start_;
};

}  // namespace flexneck::pipeline
