// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/path_error.h"

#include <algorithm>
#include <array>
#include <system_error>

#include <climits>

namespace flexneck {

bool is_of_path(const std::filesystem::filesystem_error& error) {
  constexpr std::array kFaults = {std::errc::filename_too_long,
                                  std::errc::no_such_file_or_directory,
                                  std::errc::not_a_directory,
                                  std::errc::is_a_directory,
                                  std::errc::too_many_symbolic_link_levels,
                                  std::errc::permission_denied,
                                  std::errc::read_only_file_system,
                                  std::errc::illegal_byte_sequence,
                                  std::errc::file_exists,
                                  std::errc::invalid_argument};
  return std::any_of(kFaults.begin(), kFaults.end(),
                     [&](std::errc fault) { return error.code() == fault; });
}

std::string text_of(const std::filesystem::filesystem_error& error) {
  const std::string hint = error.code() == std::errc::filename_too_long
                               ? "; a name has at most " + std::to_string(NAME_MAX) +
                                     " bytes, a path " + std::to_string(PATH_MAX - 1)
                               : "";
  return error.path1().string() + ": " + error.code().message() + hint;
}

}  // namespace flexneck
