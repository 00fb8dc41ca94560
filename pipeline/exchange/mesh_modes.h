// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/modal_body_file.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/run/command_input.h"

namespace flexneck::pipeline {

/// Reads the folder's modes of this mesh.
/// @throws InputError if they were made with other values or belong to another mesh.
fe_modal::ModalBody modes_of_mesh(const CommandInput& input, const mesher::Mesh& mesh);

/// @throws InputError if the modes that a file holds belong to another mesh.
void require_modes_of(const mesher::Mesh& mesh, const fe_modal::ModalBody& body,
                      const std::filesystem::path& modes_file);

}  // namespace flexneck::pipeline
