// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

namespace flexneck::pipeline {

/// A thread that runs the work it is given, one piece after another: for gmsh, PETSc and MPI, which
/// must be called from one thread only.
class SerialThread {
 public:
  SerialThread();
  ~SerialThread();  ///< finishes the waiting work first
  SerialThread(const SerialThread&) = delete;
  SerialThread& operator=(const SerialThread&) = delete;

  /// Runs work and waits for it. Files that it reads count as read by the calling thread.
  /// @throws what the work throws.
  void run(const std::function<void()>& work);

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  ///< declared last: it uses the other members
};

}  // namespace flexneck::pipeline
