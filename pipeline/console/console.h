// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "geometry/foundation/progress.h"

namespace flexneck::pipeline {

/// How much the command says; `none` is for a rank of which another one speaks.
enum class Verbosity { none, quiet, normal, verbose };

/// Kinds of what a console says.
enum class Message { result, step, warning, error, detail };

/// What every program of ours does first, before any file is opened.
/// A standard stream that is closed would give its number to a file, and what is printed would go
/// into a result: what is printed to it fails from here on. What is temporary goes if a signal ends
/// the process (signal_cleanup.h), and a file that may not grow is a failure to write, no end.
void prepare_process();

/// @throws ComputationError if what was printed to standard output has not all been written.
void require_written_output();

/// Progress and errors go to standard error, results to standard output. What a terminal would obey
/// is spelt out (geometry/foundation/printable.h), since names come from foreign files. All but
/// results are one line each.
class Console {
 public:
  explicit Console(Verbosity verbosity);
  /// Says nothing itself: all goes to a receiver, which may throw what ends the work.
  /// @param checkpoint  may, too; long computations call it now and then
  using Receiver = std::function<void(Message kind, const std::string& text)>;
  Console(Receiver receiver, std::function<void()> checkpoint);

  /// Verdicts and short tables, within kConsoleColumns (wrapped_text.h); silent when quiet.
  /// @throws ComputationError if standard output cannot be written.
  void result(const std::string& text) const;
  /// All other tables: shown when verbose.
  void table(const std::string& text) const;
  bool is_verbose() const { return verbosity_ == Verbosity::verbose; }
  void step(const std::string& line) const;     ///< what is done now; silent when quiet
  void warning(const std::string& line) const;  ///< always: a result may not be what it seems
  void error(const std::string& line) const;    ///< always
  Progress detail() const;                      ///< for the stages: shown when verbose
  /// What a computation calls now and then; empty where nobody wants to stop it.
  const std::function<void()>& checkpoint() const { return checkpoint_; }
  /// For the stages: warnings that begin with what they are of.
  Progress warnings(const std::string& of) const;
  /// The same console, of whose warnings someone else hears, too.
  Console with_listener(Progress on_warning) const;

 private:
  bool hand_on(Message kind, const std::string& text) const;

  Verbosity verbosity_;
  Receiver receiver_;
  std::function<void()> checkpoint_;
  Progress on_warning_;
};

}  // namespace flexneck::pipeline
