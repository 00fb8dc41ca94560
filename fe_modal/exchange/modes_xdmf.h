// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/modal_body.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Writes "modes.xdmf" beside "modes.h5" for ParaView: a grid for each part of the mesh, and each
/// mode under its name, a vector in kg^(-1/2) at the nodes, to warp the grid by. Positions are read
/// from the modal body's file, shapes from "modes_view.h5" beside it, the elements from
/// "mesh_view.h5", which mesher::write_xdmf() writes.
/// @param modes_file the file already written from `body`, in the folder of mesh_file
/// @pre body has the nodes of the mesh
/// @throws InputError if the folder cannot be written.
void write_modes_xdmf(const std::filesystem::path& modes_file,
                      const std::filesystem::path& mesh_file, const mesher::Mesh& mesh,
                      const ModalBody& body);

}  // namespace flexneck::fe_modal
