// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/hdf5_file.h"
#include "mesher/mesh/connections.h"

namespace flexneck::mesher {

/// Writes the group /connections of a mesh file (mesh_file.md); nothing if there are none.
void write_connections(Hdf5Writer& file, const Connections& connections);
/// Reads the group /connections.
/// @throws InputError as Hdf5Reader, and for lists whose lengths do not fit together.
Connections read_connections(const Hdf5Reader& file);

}  // namespace flexneck::mesher
