// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace flexneck {

/// How long the steps of a computation took, one after the other, by the clock on the wall. It goes
/// to the user and never into a result: results have the same bytes each time.
class StepTimes {
 public:
  /// Begins a step and ends the one before. A step that is begun again goes on.
  void start(const std::string& step);
  void stop();

  /// "read 0.05, assemble 0.41, solve 1.20; 1.66 s together"
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<std::pair<std::string, double>> steps_;  ///< name and seconds, in order
  std::string running_;                                ///< empty: none
  Clock::time_point since_;
};

}  // namespace flexneck
