// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/exchange/inp_model.h"

namespace flexneck::mesher {

/// Adds the data of *NSET or *ELSET to the set that `parameter` names: numbers and names of sets
/// that were read before, or ranges (GENERATE).
/// @throws InputError with the line; for an unknown set with the nearest name.
void read_inp_set(const InpCard& card, const std::string& parameter, InpSets& sets);

void add_to_inp_set(InpSets& sets, const std::string& name,
                    const std::vector<std::int64_t>& members);

/// Returns whether a field is the name of a set, not a number.
bool is_inp_set(const InpData& line, std::size_t field, const InpSets& sets);

/// The numbers that a field stands for: its own number, or the members of the set it names.
std::vector<std::int64_t> inp_members_of(const InpData& line, std::size_t field,
                                         const InpSets& sets, const std::string& kind);

}  // namespace flexneck::mesher
