// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// The folder of the files shipped with the program, laid out as in the sources: share/flexneck
/// beside or above the running program or Python module. So an installed program finds it wherever
/// its prefix has been moved to (<prefix>/bin/flexneck, <prefix>/share/flexneck), and one that is
/// not installed finds that of its build.
/// @throws ComputationError if there is none.
std::filesystem::path shipped_folder();

/// Path of a shipped file. @param path  as in the sources, such as "geometry/neck.geo"
std::filesystem::path shipped_file(const std::filesystem::path& path);

/// Path of a shared object or program shipped with the program: in lib/flexneck beside or above the
/// running program or Python module.
/// @throws ComputationError if there is none.
std::filesystem::path library_file(const std::string& name);

/// Sorted names by which named_file() finds shipped studies and models, such as "hybrid3_a".
std::vector<std::string> shipped_names();

/// The TOML file that a user names: the file of this name in `folder`, with or without its
/// extension .toml; for a name without a path also the shipped study or model of this name.
/// @param folder  the current folder if empty
/// @throws InputError for a name without a path that is neither, listing the places searched.
std::filesystem::path named_file(const std::filesystem::path& name,
                                 const std::filesystem::path& folder = {});

}  // namespace flexneck::pipeline
