// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flexneck::pipeline {

/// What a child tells its parent: a line of its standard output, which it shares with whatever
/// libraries print there.
struct ChildReport {
  enum class Kind : char {
    detail = 'd',             ///< of progress
    warning = 'w',            ///< for the user
    file_read = 'r',          ///< hash and path of a file that it has read
    input_error = 'i',        ///< why it ends with kChildInputError
    computation_error = 'c',  ///< why it ends with kChildComputationError
  };
  Kind kind = Kind::detail;
  std::string text;
};

inline constexpr int kChildInputError = 2;
inline constexpr int kChildComputationError = 3;
inline constexpr int kChildOutOfMemory = 4;

/// With its end.
std::string line_of(const ChildReport& report);
/// The report that a line holds, behind what a library may have begun to print; none if it is
/// another line.
std::optional<ChildReport> report_in(std::string_view line);

}  // namespace flexneck::pipeline
