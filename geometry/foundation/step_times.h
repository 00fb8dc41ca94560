// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace flexneck {

/// How long the steps of a computation took, one after the other, by the clock on the wall, and the
/// most memory that the process had had at their ends. It goes to the user and never into a result:
/// results have the same bytes each time.
class StepTimes {
 public:
  /// Begins a step and ends the one before. A step that is begun again goes on.
  void start(const std::string& step);
  void stop();

  /// "read 0.05 s, 0.10 GB; assemble 0.41 s, 0.12 GB; solve 1.20 s, 0.27 GB; 1.66 s together"
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Step {
    std::string name;
    double spent_s = 0;
    double peak_bytes = 0;
  };

  std::vector<Step> steps_;  ///< in order
  std::string running_;      ///< empty: none
  Clock::time_point since_;
};

}  // namespace flexneck
