// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/model/piece_sections.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// What a body is for.
enum class BodyUse {
  experiments,   ///< without the frequencies of a body attached
  attached,      ///< with these
  static_tests,  ///< without them, and with the moduli that materials have in static tests
};

/// The mesh with each material's modulus of static tests.
mesher::Mesh with_static_moduli(mesher::Mesh mesh, const MaterialModels& models);

/// A line where rounding costs more digits of the modes than frequencies are given with, else
/// empty.
/// @throws ComputationError where the result is wrong.
std::string rounding_remark(const mesher::Mesh& mesh, const fe_modal::ModalOptions& options,
                            const fe_modal::ModalBody& body);

/// The modes of a mesh by what the study says of them, on this process alone, not counted.
/// @pre a fe_modal::PetscSession
/// @throws as fe_modal::analyse_modes(), modes_options() and rounding_remark() do.
fe_modal::ModalBody modes_of_mesh(const Study& study, mesher::Mesh mesh, BodyUse use);

/// The modes of the study's substructures, without shapes.
/// @pre a fe_modal::PetscSession
/// @throws as substructures_of() and fe_modal::analyse_modes() do.
Pieces modes_of_pieces(const Study& study, mesher::Mesh mesh);

/// The modes of the study's [matrices].
/// @pre study.matrices, a fe_modal::PetscSession
fe_modal::ModalBody solved_matrices(const Study& study);

/// What experiments need of a body: without the shapes at its nodes, and of the nodes two corners
/// of the box round them. It is a hundredth of the size.
fe_modal::ModalBody without_shapes(fe_modal::ModalBody body);

}  // namespace flexneck::pipeline
