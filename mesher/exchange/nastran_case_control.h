// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

/// The sets that the lines before BEGIN BULK select.
struct NastranCaseControl {
  bool is_given = false;                     ///< the file has a BEGIN BULK
  std::map<std::string, std::int64_t> sets;  ///< number of the selected set, by "SPC" and "MPC"
};

/// Reads the case control.
/// @param text content of the whole file
/// @param left_out gets the prestress that a STATSUB asks for
/// @throws InputError with the line for a set that is not a number, subcases that select different
/// sets, matrices of the structure (K2GG, M2GG) and INCLUDE.
NastranCaseControl read_nastran_case_control(std::string_view text, LeftOut& left_out);

}  // namespace flexneck::mesher
