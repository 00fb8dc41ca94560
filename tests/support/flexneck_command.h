// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "tests/support/run_command.h"

namespace flexneck::testing {

/// Path of the command that this build made.
inline std::string flexneck_program() { return std::string(FLEXNECK_BINARY_DIR) + "/flexneck"; }

inline CommandOutcome run_flexneck(const std::string& arguments) {
  return run_shell(flexneck_program() + " " + arguments);
}

/// Number of lines that are not warnings.
inline int plain_lines(const std::string& text) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with("Warning: ") ? 0 : 1;
  return count;
}

/// Checks that the command gives its reason in one clear line, after its warnings.
/// @param reason part of that line
inline void check_refused(const CommandOutcome& outcome, const std::string& reason,
                          int exit_code = 2) {
  INFO(outcome.text);
  CHECK(outcome.exit_code == exit_code);
  CHECK_THAT(outcome.text, Catch::Matchers::Contains(reason));
  CHECK(plain_lines(outcome.text) == 1);
}

}  // namespace flexneck::testing
