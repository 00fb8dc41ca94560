// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sys/types.h>

namespace flexneck {

/// Makes signals clean up before they end the process, except those that are handled otherwise or
/// ignored. For programs only: a library leaves signals to its program.
void clean_up_on_signals();
/// Runs the registered cleanups, in a program that ends otherwise than by leaving main.
void clean_up_now() noexcept;

/// Removes a folder with all its contents, as far as possible, without allocating memory.
void remove_folder(const std::filesystem::path& folder) noexcept;

/// While an object exists, signals that ask for an end wait: from the creation of a file, a folder
/// or a child process until it is registered as a SignalCleanup. The end of the last object
/// delivers them.
class SignalHold {
 public:
  SignalHold() noexcept;
  ~SignalHold();
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;
};

/// Cleans up something that would be left behind if a signal ended the process now. Otherwise its
/// owner removes it.
class SignalCleanup {
 public:
  /// Actions, in the order in which they are performed.
  enum class Action : unsigned char {
    end_process,
    remove_folder,  ///< with all its contents
    remove_file,
    remove_empty_folder,
  };

  SignalCleanup() = default;
  /// Registers the removal of a path. `action` is not Action::end_process.
  SignalCleanup(Action action, const std::filesystem::path& path);
  /// Registers the end of a child process.
  explicit SignalCleanup(pid_t process);
  ~SignalCleanup() { reset(); }
  SignalCleanup(SignalCleanup&& other) noexcept;
  SignalCleanup& operator=(SignalCleanup&& other) noexcept;
  SignalCleanup(const SignalCleanup&) = delete;
  SignalCleanup& operator=(const SignalCleanup&) = delete;

  void reset() noexcept;

 private:
  int entry_ = -1;  ///< -1: no action, or no entry left to register it
};

}  // namespace flexneck
