// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// The folder of the files that come with the program, which stand in it as in the sources:
/// share/flexneck beside or above the running program or Python module. So an installed program
/// finds it wherever its prefix has been moved to (<prefix>/bin/flexneck, <prefix>/share/flexneck),
/// and one that is not installed finds that of its build.
/// @throws ComputationError if there is none.
std::filesystem::path shipped_folder();

/// A file in it. @param path  as in the sources, such as "geometry/neck.geo"
std::filesystem::path shipped_file(const std::filesystem::path& path);

/// A shared object or another program that comes with the program: in lib/flexneck beside or above
/// the running program or Python module.
/// @throws ComputationError if there is none.
std::filesystem::path library_file(const std::string& name);

/// Names by which named_file() finds shipped studies and models, such as "hybrid3_a", in order.
std::vector<std::string> shipped_names();

/// The TOML file that a user names: the one of this name in `folder`, with or without its ending
/// .toml; of a name without a path also the shipped study or model of this name.
/// @param folder  empty: the current one
/// @throws InputError for a name without a path that is neither, with what was looked for.
std::filesystem::path named_file(const std::filesystem::path& name,
                                 const std::filesystem::path& folder = {});

}  // namespace flexneck::pipeline
