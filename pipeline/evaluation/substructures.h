// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/pieces.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A piece of the structure that becomes a body of its own.
struct Substructure {
  std::string name;
  mesher::Mesh mesh;
  fe_modal::ModalOptions options;
};

/// Cuts the structure and says how each piece is analysed: the first is fixed as the whole is, each
/// other where it meets the earliest of those before it. All other cuts, and the whole's interfaces
/// on the piece, are interfaces whose static shapes are kept. The interface on a cut has the cut's
/// name (mesher::cut_name) and lies in the middle of its nodes, so that two pieces meet at a point.
/// @param whole how the whole is analysed
/// @throws InputError for pieces that cannot be cut, that hang together with no earlier one, or
/// that divide an interface of the whole.
std::vector<Substructure> substructures(const SubstructuresSection& section,
                                        const mesher::Mesh& mesh,
                                        const fe_modal::ModalOptions& whole);

/// Those of a study. @throws InputError as substructures(), with the study in front
std::vector<Substructure> substructures_of(const Study& study, const mesher::Mesh& mesh,
                                           const fe_modal::ModalOptions& whole);

/// @param body  of the piece, with its shapes
/// @throws InputError if a section of the study's cases is that piece, and the face at its top is
/// not rigid enough to be condensed to six motions
void require_rigid_face(const Study& study, const Substructure& piece,
                        const fe_modal::ModalBody& body);

}  // namespace flexneck::pipeline
