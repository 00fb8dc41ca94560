// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace flexneck {

inline constexpr const char* kFreshPrefix = ".flexneck-";

/// Tries new hidden names in the folder until one is free.
/// @param take  creates the entry of that name; returns false with errno if it cannot
/// @return the name, or an empty one with errno.
template <typename Take>
std::filesystem::path take_fresh_name(const std::filesystem::path& folder, const Take& take) {
  for (int number = 0;; ++number) {
    std::filesystem::path name = folder / (kFreshPrefix + std::to_string(::getpid()) + "-" +
                                           std::to_string(number) + ".part");
    if (take(name)) return name;
    if (errno != EEXIST) return {};
  }
}

}  // namespace flexneck
