// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/run_rows.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace flexneck::pipeline {

namespace {

class Run {
 public:
  explicit Run(const RowRun& run) : run_(run) {}

  bool operator()() {
    std::vector<std::jthread> threads;
    for (unsigned k = 0; k < run_.threads; ++k) threads.emplace_back([this] { compute(); });
    try {
      while (std::unique_ptr<Place> place = next_done()) run_.take(place->result);
    } catch (...) {
      end(std::current_exception());
    }
    threads.clear();  // joins them
    if (failure_) std::rethrow_exception(failure_);
    return !was_stopped_;
  }

 private:
  /// A row being computed; the first of the queue is the next to be passed on.
  struct Place {
    RowResult result;
    bool is_done = false;
  };

  void compute() {
    try {
      while (Place* const place = next_place()) {
        RowResult result = run_.compute(place->result.row);
        const std::scoped_lock lock(mutex_);
        place->result = std::move(result);
        place->is_done = true;
        changed_.notify_all();
      }
    } catch (...) {
      end(std::current_exception());
    }
    const std::scoped_lock lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }

  /// Returns a place for the next row; waits while the threads are far ahead of the rows passed on.
  Place* next_place() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_ended_ || queue_.size() < kAhead * run_.threads; });
    if (run_.is_stopped != nullptr && run_.is_stopped->load()) was_stopped_ = is_ended_ = true;
    if (is_ended_) return nullptr;
    const std::optional<std::uint64_t> row = run_.next_due();
    if (!row) return nullptr;
    queue_.push_back(std::make_unique<Place>());
    queue_.back()->result.row = *row;
    return queue_.back().get();
  }

  std::unique_ptr<Place> next_done() {
    std::unique_lock lock(mutex_);
    const auto is_first_done = [&] { return !queue_.empty() && queue_.front()->is_done; };
    changed_.wait(lock, [&] { return is_first_done() || ended_ == run_.threads; });
    if (!is_first_done()) return nullptr;
    std::unique_ptr<Place> place = std::move(queue_.front());
    queue_.pop_front();
    changed_.notify_all();
    return place;
  }

  void end(const std::exception_ptr& why) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = why;
    is_ended_ = true;
    changed_.notify_all();
  }

  static constexpr std::size_t kAhead = 16;  ///< rows per thread that may wait for an earlier one

  const RowRun& run_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::unique_ptr<Place>> queue_;
  unsigned ended_ = 0;  ///< number of finished threads
  bool is_ended_ = false;
  bool was_stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

bool run_rows(const RowRun& run) { return Run(run)(); }

}  // namespace flexneck::pipeline
