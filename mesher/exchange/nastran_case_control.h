// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace flexneck::mesher {

/// Sets that "SPC = 1" and "MPC = 2" of the case control select.
struct NastranCaseControl {
  bool is_given = false;                               ///< the file has a BEGIN BULK
  std::map<std::string, std::set<std::int64_t>> sets;  ///< by the word in capitals
};

/// @param text of the whole file
NastranCaseControl read_nastran_case_control(std::string_view text);

}  // namespace flexneck::mesher
