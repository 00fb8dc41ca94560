// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <mutex>
#include <sys/types.h>

namespace flexneck {

/// Starts a thread that waits for SIGINT, SIGTERM and SIGHUP. It ends the registered child
/// processes, removes the registered paths, and lets the signal end the process; a SIGINT that has
/// a handler only calls it, in this thread. A signal that is ignored stays ignored. The
/// signals are blocked in the calling thread and in those that it starts later: call it before
/// any other thread exists, and start programs by SpawnActions. For programs only: a library leaves
/// signals to its program.
void clean_up_on_signals();
/// Runs the registered cleanups, in a program that ends otherwise than by leaving main.
void clean_up_now() noexcept;

/// Removes a file, or a folder with all its contents, as far as possible.
void remove_whole(const std::filesystem::path& path) noexcept;

/// While an object exists, no signal cleans up: from the creation of a file, a folder or a child
/// process until it is registered as a SignalCleanup. Once a cleanup has begun, a new object waits
/// for the end of the process.
class SignalHold {
 public:
  SignalHold();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// Cleans up something that would be left behind if a signal ended the process now. Otherwise its
/// owner removes it.
class SignalCleanup {
 public:
  /// Actions, in the order in which they are performed.
  enum class Action : unsigned char {
    end_process,
    remove,  ///< a file, or a folder with all its contents
    remove_empty_folder,
  };

  SignalCleanup() = default;
  /// Registers the removal of a path. `action` is not Action::end_process.
  SignalCleanup(Action action, std::filesystem::path path);
  /// Registers the end of a child process.
  explicit SignalCleanup(pid_t process);
  ~SignalCleanup() { reset(); }
  SignalCleanup(SignalCleanup&& other) noexcept;
  SignalCleanup& operator=(SignalCleanup&& other) noexcept;
  SignalCleanup(const SignalCleanup&) = delete;
  SignalCleanup& operator=(const SignalCleanup&) = delete;

  void reset() noexcept;

 private:
  int entry_ = -1;  ///< number of the registered entry; -1 for none
};

}  // namespace flexneck
