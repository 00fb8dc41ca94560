// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::mesher {

/// Output requests, the control of an analysis, properties that only other analyses ask for: they
/// change neither mesh nor modes.
bool is_silent_keyword(const std::string& keyword);

/// Loads, prestress and damping: they change what is computed from the deck, but a mesh cannot hold
/// them.
bool is_left_out_keyword(const std::string& keyword);

/// Parts, instances and assembly.
bool is_assembly_keyword(const std::string& keyword);

}  // namespace flexneck::mesher
