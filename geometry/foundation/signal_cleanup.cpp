// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/signal_cleanup.h"

#include <csignal>
#include <map>
#include <memory>
#include <new>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <utility>

#include "geometry/foundation/file_descriptor.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

using Action = SignalCleanup::Action;

struct Entry {
  Action action = Action::remove;
  pid_t process = -1;
  fs::path path = {};
  pid_t owner = ::getpid();  ///< a forked child does not clean up for its parent
};

struct Registry {
  std::recursive_mutex mutex;  ///< recursive, as entries are added while a SignalHold exists
  std::map<int, Entry> entries;
  int next = 0;

  int add(Entry entry) {
    const std::lock_guard lock(mutex);
    entries.emplace(next, std::move(entry));
    return next++;
  }
};

/// The registry is never destroyed: the waiting thread may use it while the process exits.
Registry& registry() {
  static Registry& only = *std::make_unique<Registry>().release();
  return only;
}

void carry_out(const Entry& entry) noexcept {
  std::error_code failure;
  switch (entry.action) {
    case Action::end_process:
      ::kill(entry.process, SIGKILL);
      uninterrupted([&] { return ::waitpid(entry.process, nullptr, 0); });
      break;
    case Action::remove:
      remove_whole(entry.path);
      break;
    case Action::remove_empty_folder:
      fs::remove(entry.path, failure);
      break;
  }
}

/// Lets the process receive a signal that is blocked.
void deliver(int signal) {
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  std::raise(signal);
  ::pthread_sigmask(SIG_BLOCK, &one, nullptr);
}

bool has_handler(int signal) {
  struct sigaction now {};
  return ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_DFL;
}

[[noreturn]] void wait_for(const sigset_t& signals) {
  for (;;) {
    int signal = 0;
    if (::sigwait(&signals, &signal) != 0) continue;
    if (signal == SIGINT && has_handler(signal)) {
      deliver(signal);
      continue;
    }
    const SignalHold until_the_end;
    clean_up_now();
    std::signal(signal, SIG_DFL);  // METIS handles SIGTERM while it works
    deliver(signal);
  }
}

}  // namespace

void clean_up_now() noexcept {
  const std::lock_guard lock(registry().mutex);
  for (const Action action : {Action::end_process, Action::remove, Action::remove_empty_folder})
    for (const auto& [number, entry] : registry().entries)
      if (entry.action == action && entry.owner == ::getpid()) carry_out(entry);
}

void remove_whole(const fs::path& path) noexcept {
  // Another thread may add to the folder while it is emptied.
  constexpr int kPasses = 8;
  std::error_code failure = std::make_error_code(std::errc::directory_not_empty);
  for (int pass = 0; pass < kPasses && failure; ++pass) {
    try {
      fs::remove_all(path, failure);
    } catch (const std::bad_alloc&) {
      return;
    }
  }
}

void clean_up_on_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (!has_handler(signal)) sigaddset(&signals, signal);  // an ignored one counts as handled
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] { wait_for(signals); }).detach();
}

SignalHold::SignalHold() : lock_(registry().mutex) {}

SignalCleanup::SignalCleanup(Action action, fs::path path)
    : entry_(registry().add({.action = action, .path = std::move(path)})) {}

SignalCleanup::SignalCleanup(pid_t process)
    : entry_(registry().add({.action = Action::end_process, .process = process})) {}

SignalCleanup::SignalCleanup(SignalCleanup&& other) noexcept
    : entry_(std::exchange(other.entry_, -1)) {}

SignalCleanup& SignalCleanup::operator=(SignalCleanup&& other) noexcept {
  reset();
  entry_ = std::exchange(other.entry_, -1);
  return *this;
}

void SignalCleanup::reset() noexcept {
  if (entry_ < 0) return;
  const SignalHold hold;
  registry().entries.erase(std::exchange(entry_, -1));
}

}  // namespace flexneck
