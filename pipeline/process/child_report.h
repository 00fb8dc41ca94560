// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flexneck::pipeline {

/// A report of a child to its parent: a line of its standard output, which it shares with the
/// output of libraries.
struct ChildReport {
  enum class Kind : char {
    detail = 'd',             ///< progress
    warning = 'w',            ///< warning for the user
    file_read = 'r',          ///< hash and path of a file that was read
    input_error = 'i',        ///< error of exit code kChildInputError
    computation_error = 'c',  ///< error of exit code kChildComputationError
  };
  Kind kind = Kind::detail;
  std::string text;
};

inline constexpr int kChildInputError = 2;
inline constexpr int kChildComputationError = 3;
inline constexpr int kChildOutOfMemory = 4;

/// Line of a report, with its line break.
std::string line_of(const ChildReport& report);
/// The report in a line, possibly behind text that a library has begun to print; none if the line
/// holds no report.
std::optional<ChildReport> report_in(std::string_view line);

}  // namespace flexneck::pipeline
