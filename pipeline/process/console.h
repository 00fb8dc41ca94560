// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "geometry/foundation/progress.h"

namespace flexneck::pipeline {

/// Verbosity of the console; `none` is for a rank when another one prints.
enum class Verbosity { none, quiet, normal, verbose };

/// Kinds of messages.
enum class Message { result, step, warning, error, detail };

/// Prepares the process; called first in every program, before any file is opened. Closed standard
/// streams are replaced, since a file would otherwise get their descriptor and printed text would
/// go into a result; printing to them fails from here on. Temporary files are removed if a signal
/// ends the process (signal_cleanup.h), and reaching the limit of a file's size is a write error
/// and does not end the process.
void prepare_process();

/// @throws ComputationError if what was printed to standard output has not all been written.
void require_written_output();

/// Prints progress and errors to standard error, results to standard output. Control characters are
/// spelt out (geometry/foundation/printable.h), since names come from foreign files. All messages
/// but results are one line each.
class Console {
 public:
  explicit Console(Verbosity verbosity);
  /// Console that prints nothing: all messages go to a receiver, which may throw to end the work.
  /// @param checkpoint  called now and then by long computations; may throw, too
  using Receiver = std::function<void(Message kind, const std::string& text)>;
  Console(Receiver receiver, std::function<void()> checkpoint);

  /// Verdicts and short tables, within kConsoleColumns (wrapped_text.h); silent when quiet.
  /// @throws ComputationError if standard output cannot be written.
  void result(const std::string& text) const;
  /// Prints any other table, when verbose.
  void table(const std::string& text) const;
  bool is_verbose() const { return verbosity_ == Verbosity::verbose; }
  void step(const std::string& line) const;     ///< the current step; silent when quiet
  void warning(const std::string& line) const;  ///< never silent: the result may be misleading
  void error(const std::string& line) const;    ///< never silent
  Progress detail() const;                      ///< printer for the stages; prints when verbose
  /// Function that a computation calls now and then; empty if nobody needs to stop it.
  const std::function<void()>& checkpoint() const { return checkpoint_; }
  /// Printer for the stages' warnings, each prefixed by `of`.
  Progress warnings(const std::string& of) const;
  /// Copy of this console whose warnings also go to another function.
  Console with_listener(Progress on_warning) const;

 private:
  bool hand_on(Message kind, const std::string& text) const;

  Verbosity verbosity_;
  Receiver receiver_;
  std::function<void()> checkpoint_;
  Progress on_warning_;
};

}  // namespace flexneck::pipeline
