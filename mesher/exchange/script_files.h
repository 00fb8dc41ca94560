// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::mesher {

/// Has all files noted that gmsh reads for a script (geometry/foundation/files_read.h): the script,
/// the options beside it, and what it names literally in Include, Merge, Open, ShapeFromFile and
/// ListFromFile, from the folder of the file that names it; scripts among them likewise. A script
/// that runs commands, asks its surroundings or puts names together is noted as one that reads what
/// nobody knows.
void note_script_files(const std::filesystem::path& script);

}  // namespace flexneck::mesher
