// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::mesher {

/// Notes all files that gmsh reads for a script (geometry/foundation/files_read.h): the script, the
/// options file beside it, and the files it names literally in Include, Merge, Open, ShapeFromFile
/// and ListFromFile, relative to the folder of the file that names them; included scripts
/// recursively. A script that runs commands, queries its environment or composes names is noted
/// with unknown reads.
void note_script_files(const std::filesystem::path& script);

}  // namespace flexneck::mesher
