// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <toml++/toml.h>

namespace flexneck::pipeline {

/// Prefixes "<assembly>:" to the names of all bodies, joints, forces and so on that a file defines,
/// and to references to them. A name that the file does not define is unchanged: it refers to the
/// file that holds the assembly. For a marker on a body of that file the marker's own name gets the
/// prefix, as in "pelvis.left_leg:hip".
/// @throws InputError for sections that an assembly cannot have, such as [solver]
void prefix_names(toml::table& content, const std::string& assembly);

/// Adds the tables of an assembly to those of the file that holds it.
/// @throws InputError if the holder uses the name of a section for something else
void append_sections(toml::table& holder, toml::table&& content);

}  // namespace flexneck::pipeline
