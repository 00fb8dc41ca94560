// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Reads a file of one or several formats, such as import_inp(). Content that a mesh cannot hold is
/// added to `left_out`.
using MeshReader = Mesh (*)(const ImportOptions& options, const Progress& progress,
                            LeftOut& left_out);

/// Performs the steps common to every import: adds the sets of boxes, checks the mesh, and puts the
/// file's name in front of the reader's error messages.
/// @param warn gets one line if the file has more than a mesh can hold, such as masses, springs,
/// supports and loads: all of it by kind and number
/// @throws InputError as the reader, LeftOut::require_named(), check() and check_import(); if no
/// face lies in a box.
Mesh checked_import(const ImportOptions& options, MeshReader read, const Progress& progress,
                    const Progress& warn);

}  // namespace flexneck::mesher
