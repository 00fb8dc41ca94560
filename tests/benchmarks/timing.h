// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace flexneck::benchmarks {

struct Timing {
  double median_ms = 0;
  double fastest_ms = 0;
};

/// CPU time of the calling thread, on which other load of the machine has little effect.
inline double cpu_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Times calls of `run`.
template <typename Run>
Timing measure(int runs, Run&& run) {
  std::vector<double> times_ms;
  for (int k = 0; k < runs; ++k) {
    const double start_ms = cpu_time_ms();
    run();
    times_ms.push_back(cpu_time_ms() - start_ms);
  }
  std::sort(times_ms.begin(), times_ms.end());
  return {times_ms[times_ms.size() / 2], times_ms.front()};
}

}  // namespace flexneck::benchmarks
