// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Reads a file of one format or some, such as import_inp(). What a mesh cannot hold is added to
/// `left_out`.
using MeshReader = Mesh (*)(const ImportOptions& options, const Progress& progress,
                            LeftOut& left_out);

/// What every import has in common: the sets of boxes, the checks, and the file's name before what
/// the reader says is wrong.
/// @param warn gets one line if the file has more than a mesh can hold, such as masses, springs,
/// supports and loads: all of it by kind and number
/// @throws InputError as the reader, LeftOut::require_named(), check() and check_import(); if no
/// face lies in a box.
Mesh checked_import(const ImportOptions& options, MeshReader read, const Progress& progress,
                    const Progress& warn);

}  // namespace flexneck::mesher
