// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/serial_thread.h"

#include <utility>
#include <vector>

#include "geometry/foundation/files_read.h"

namespace flexneck::pipeline {

SerialThread::SerialThread() : thread_([this] { serve(); }) {}

SerialThread::~SerialThread() {
  {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void SerialThread::run(const std::function<void()>& work) {
  std::vector<FileRead> read;
  std::packaged_task<void()> task([&] {
    const FilesRead reads;
    const auto keep = [&] { read = reads.files(); };
    try {
      work();
    } catch (...) {
      keep();
      throw;
    }
    keep();
  });
  std::future<void> done = task.get_future();
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
  done.wait();
  note_reads(read);
  done.get();
}

void SerialThread::serve() {
  for (;;) {
    std::packaged_task<void()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return is_ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      task = std::move(waiting_.front());
      waiting_.pop_front();
    }
    task();
  }
}

}  // namespace flexneck::pipeline
