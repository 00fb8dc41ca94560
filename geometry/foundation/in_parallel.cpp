// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/in_parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace flexneck {

void in_parallel(std::size_t count, unsigned threads,
                 const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> others;
  for (unsigned k = 1; k < threads && k < count; ++k) others.emplace_back(run);
  run();
  others.clear();  // joins the threads
  if (failure) std::rethrow_exception(failure);
}

}  // namespace flexneck
