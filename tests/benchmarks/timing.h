// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace flexneck::benchmarks {

struct Timing {
  double median_ms = 0;
  double fastest_ms = 0;
};

/// Times calls of `run`.
template <typename Run>
Timing measure(int runs, Run&& run) {
  std::vector<double> times_ms;
  for (int k = 0; k < runs; ++k) {
    const auto start = std::chrono::steady_clock::now();
    run();
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    times_ms.push_back(spent.count());
  }
  std::sort(times_ms.begin(), times_ms.end());
  return {times_ms[times_ms.size() / 2], times_ms.front()};
}

}  // namespace flexneck::benchmarks
