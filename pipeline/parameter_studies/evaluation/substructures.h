// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/pieces.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// A submesh of the structure that becomes a body of its own.
struct Substructure {
  std::string name;
  mesher::Mesh mesh;
  fe_modal::ModalOptions options;
};

/// Cuts the structure and sets the options for each submesh: the first is fixed like the whole,
/// each other one where it meets the earliest submesh before it. All other cuts, and the whole's
/// interfaces on the submesh, are interfaces whose static shapes are kept. The interface on a cut
/// has the cut's name (mesher::cut_name) and lies in the middle of its nodes, so that two submeshes
/// meet at a point.
/// @param whole options of the whole structure's analysis
/// @throws InputError for submeshes that cannot be cut, that are connected to no earlier one, or
/// that divide an interface of the whole.
std::vector<Substructure> substructures(const SubstructuresSection& section,
                                        const mesher::Mesh& mesh,
                                        const fe_modal::ModalOptions& whole);

/// Substructures of a study. @throws InputError as substructures(), prefixed with the study
std::vector<Substructure> substructures_of(const Study& study, const mesher::Mesh& mesh,
                                           const fe_modal::ModalOptions& whole);

/// Fails if the top face of a submesh that a case uses as a section is too flexible.
/// @param body  modes of the submesh, with its shapes
/// @throws InputError if a section of the study's cases is that submesh, and its top face is not
/// rigid enough to be condensed to six motions
void require_rigid_face(const Study& study, const Substructure& piece,
                        const fe_modal::ModalBody& body);

}  // namespace flexneck::pipeline
