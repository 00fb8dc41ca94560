// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sys/types.h>

namespace flexneck {

/// Has signals clean up before they end the process, save those that something else handles or
/// ignores. For a program: a library leaves signals to the program.
void clean_up_on_signals();
/// For a program that ends otherwise than by leaving main.
void clean_up_now() noexcept;

/// A folder with all in it, as far as that can be done; takes no memory.
void remove_folder(const std::filesystem::path& folder) noexcept;

/// While there is one, signals that ask for an end wait: between making a file, a folder or a child
/// process and noting it as a SignalCleanup. The last one that goes lets them through.
class SignalHold {
 public:
  SignalHold() noexcept;
  ~SignalHold();
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;
};

/// What would be left behind if a signal ended the process now. It is up to its owner otherwise.
class SignalCleanup {
 public:
  /// In the order in which they are done.
  enum class Action : unsigned char {
    end_process,
    remove_folder,  ///< with all in it
    remove_file,
    remove_empty_folder,
  };

  SignalCleanup() = default;
  /// Not for Action::end_process.
  SignalCleanup(Action action, const std::filesystem::path& path);
  /// Of a child process.
  explicit SignalCleanup(pid_t process);
  ~SignalCleanup() { reset(); }
  SignalCleanup(SignalCleanup&& other) noexcept;
  SignalCleanup& operator=(SignalCleanup&& other) noexcept;
  SignalCleanup(const SignalCleanup&) = delete;
  SignalCleanup& operator=(const SignalCleanup&) = delete;

  void reset() noexcept;

 private:
  int entry_ = -1;  ///< none: nothing to do, or no place left to note it
};

}  // namespace flexneck
