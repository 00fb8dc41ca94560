// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

namespace flexneck::pipeline {

/// A thread that does what others hand it, one piece of work after another: for gmsh, PETSc and
/// MPI, which want to be called from one thread only.
class SerialThread {
 public:
  SerialThread();
  ~SerialThread();  ///< does what is waiting first
  SerialThread(const SerialThread&) = delete;
  SerialThread& operator=(const SerialThread&) = delete;

  /// Waits until the work is done. Files that it reads count as read by the thread that waits.
  /// @throws what the work throws.
  void run(const std::function<void()>& work);

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace flexneck::pipeline
