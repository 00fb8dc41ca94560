// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/modal_body.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Writes the modal file of a deformable segment for the Articulated Total Body model (ATB),
/// version V.3 of 2004, which its card B.1.b names without the ending `.dat`. Free format, by
/// records:
///   number of nodes and of modes;
///   x y z of each node, a record each;
///   the nodes' masses;
///   the modes' frequencies in Hz;
///   a record for each mode: three translations for each node, then three rotations in rad.
/// The program does not read further; notes there describe the contents.
///
/// The manual of this version is not published. The order of the records, the fact that nodal
/// masses are masses and not weights, and the meaning of the six numbers are inferred from how the
/// program reads and uses them. Its numbers carry no units: inch, lbf and second are inferred from
/// the usual decks (card A.3), so masses are in lbf s^2/in.
///
/// The nodes are the corners of the elements, which bear all mass (corner_fields.h), and the modes
/// the lowest ones of the kind "normal", because the program takes 4000 nodes and four modes. It
/// scales translations, not rotations, so that sum m |phi|^2 = 1: the file's modes satisfy this
/// already, with rotations on the same scale.
/// @pre body has the nodes of the mesh
/// @throws InputError for more than 4000 corners, a body without normal modes, or a file that
/// cannot be written.
void write_atb_modal_file(const std::filesystem::path& path, const mesher::Mesh& mesh,
                          const ModalBody& body);

}  // namespace flexneck::fe_modal
