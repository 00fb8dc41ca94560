// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/language/model/piece_sections.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Purpose of a body's modes.
enum class BodyUse {
  experiments,   ///< without the frequencies of an attached body
  attached,      ///< with the frequencies of an attached body
  static_tests,  ///< without them, and with the static moduli of materials
};

/// Returns the mesh with each material's modulus for static tests.
mesher::Mesh with_static_moduli(mesher::Mesh mesh, const MaterialModels& models);

/// Returns a remark if rounding costs more digits of the modes than frequencies are printed with,
/// else an empty text.
/// @throws ComputationError if the result is wrong.
std::string rounding_remark(const mesher::Mesh& mesh, const fe_modal::ModalOptions& options,
                            const fe_modal::ModalBody& body);

/// Solves for the modes of a mesh by the study's options, on this process alone, not counted.
/// @pre a fe_modal::PetscSession
/// @throws as fe_modal::analyse_modes(), modes_options() and rounding_remark() do.
fe_modal::ModalBody modes_of_mesh(const Study& study, mesher::Mesh mesh, BodyUse use);

/// Solves for the modes of the study's substructures, without shapes.
/// @pre a fe_modal::PetscSession
/// @throws as substructures_of() and fe_modal::analyse_modes() do.
Pieces modes_of_pieces(const Study& study, mesher::Mesh mesh);

/// Solves for the modes of the study's [matrices].
/// @pre study.matrices, a fe_modal::PetscSession
fe_modal::ModalBody solved_matrices(const Study& study);

/// Returns the part of a body that experiments need: without nodal shapes, and with two corners of
/// the bounding box for the nodes. It is a hundredth of the size.
fe_modal::ModalBody without_shapes(fe_modal::ModalBody body);

}  // namespace flexneck::pipeline
