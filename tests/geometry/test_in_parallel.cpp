// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/in_parallel.h"

using flexneck::in_parallel;

TEST_CASE(
    "in parallel each task is done once, by at most so many threads, the caller's among them") {
  for (const unsigned threads : {1U, 2U, 7U}) {
    std::vector<int> times(1000, 0);
    std::vector<std::thread::id> workers(times.size());
    in_parallel(times.size(), threads, [&](std::size_t k) {
      ++times[k];
      workers[k] = std::this_thread::get_id();
    });
    CHECK(times == std::vector<int>(times.size(), 1));
    CHECK(std::set(workers.begin(), workers.end()).size() <= threads);
    if (threads == 1) CHECK(workers.front() == std::this_thread::get_id());
  }
  in_parallel(0, 3, [](std::size_t /*k*/) { FAIL("there was nothing to do"); });
}

TEST_CASE("what a task throws in parallel reaches the caller when all threads have ended") {
  std::atomic<int> running = 0;
  const auto work = [&](std::size_t k) {
    ++running;
    if (k == 20) {
      --running;
      throw std::runtime_error("task 20");
    }
    std::this_thread::yield();
    --running;
  };
  CHECK_THROWS_WITH(in_parallel(1000, 4, work), "task 20");
  CHECK(running == 0);
}
