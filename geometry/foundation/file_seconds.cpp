// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/file_seconds.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace flexneck {

namespace {

std::atomic<std::int64_t>& nanoseconds(FileClock::Work work) {
  static std::array<std::atomic<std::int64_t>, 2> counted{};
  return counted[static_cast<std::size_t>(work)];
}

double seconds(FileClock::Work work) { return 1e-9 * static_cast<double>(nanoseconds(work)); }

}  // namespace

FileSeconds file_seconds() {
  return {seconds(FileClock::Work::hash), seconds(FileClock::Work::sync)};
}

FileClock::~FileClock() {
  const auto spent = std::chrono::steady_clock::now() - since_;
  nanoseconds(work_) += std::chrono::duration_cast<std::chrono::nanoseconds>(spent).count();
}

}  // namespace flexneck
