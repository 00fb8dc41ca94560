// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "fe_modal/body/modal_body.h"
#include "geometry/foundation/hdf5_file.h"

namespace flexneck::fe_modal {

/// Writes the group /geometric_stiffness of a modal body file (modes_file.md).
void write_geometric_stiffness(Hdf5Writer& file, const GeometricStiffness& stiffness);
/// Reads the group; nothing if the file has no such group.
/// @param m number of modes
/// @throws InputError if a dataset is missing or has another shape.
std::optional<GeometricStiffness> read_geometric_stiffness(const Hdf5Reader& file, std::size_t m);

}  // namespace flexneck::fe_modal
