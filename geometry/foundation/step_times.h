// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace flexneck {

/// Wall-clock times of the consecutive steps of a computation, and the process's peak memory at
/// their ends. They are shown to the user and never stored in a result: results have the same bytes
/// each time.
class StepTimes {
 public:
  /// Begins a step and ends the one before. A step that begins again is continued.
  void start(const std::string& step);
  void stop();

  /// Text "read 0.05 s, 0.10 GB; assemble 0.41 s, 0.12 GB; solve 1.20 s, 0.27 GB; 1.66 s together".
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Step {
    std::string name;
    double spent_s = 0;
    double peak_bytes = 0;
  };

  std::vector<Step> steps_;  ///< in order
  std::string running_;      ///< empty if none runs
  Clock::time_point since_;
};

}  // namespace flexneck
