// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <toml++/toml.h>

namespace flexneck::pipeline {

/// Puts the prefix "<assembly>:" to the names of all bodies, joints, forces and so on that a file
/// gives, and to what refers to them. A name that the file does not give stays as it is: it refers
/// to the file that holds the assembly. A marker on a body of that file has the prefix in its own
/// name, as in "pelvis.left_leg:hip".
/// @throws InputError for sections that an assembly cannot have, such as [solver]
void prefix_names(toml::table& content, const std::string& assembly);

/// Adds the tables of an assembly to those of the file that holds it.
/// @throws InputError where that has something else under a section's name
void append_sections(toml::table& holder, toml::table&& content);

}  // namespace flexneck::pipeline
