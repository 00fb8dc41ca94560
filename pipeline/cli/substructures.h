// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/cli/commands.h"
#include "pipeline/language/model/piece_sections.h"

namespace flexneck::pipeline {

/// Analyses the study's substructures, if it has any, writes a file of modes for each into the
/// folder of results and prints a summary.
/// @param provenance provenance of the whole structure's modes
void write_substructures(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& whole, const Provenance& provenance);

/// Reads the modes of the study's submeshes from their files, which are appended to `files`.
/// @throws InputError if one is missing or was made with other values than the study has now.
Pieces read_pieces(const CommandInput& input, std::vector<InputFile>& files);

/// Returns the study with the stiffness of its submeshes in those cases that have them as sections;
/// unchanged if no case has. @throws as read_pieces() and attach_pieces() do.
Study with_pieces(const CommandInput& input, std::vector<InputFile>& files);

}  // namespace flexneck::pipeline
