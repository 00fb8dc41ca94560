// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "pipeline/console/console.h"
#include "pipeline/evaluation/structure_modes.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A study with one number moved a little.
struct MovedStudy {
  Study study;
  double width = 0;  ///< by how much, with its sign
};

/// Figures of the modes and their derivatives by the numbers that are moved.
struct FigureSlopes {
  Eigen::VectorXd values;       ///< (n) SI
  Eigen::MatrixXd derivatives;  ///< (n, p)
};

/// Whether two studies differ, as far as modes go, in what the mesh is made from alone: in
/// dimensions or material constants. Derivatives by what changes nothing else are known in closed
/// form.
bool differ_in_mesh_only(const Study& a, const Study& b);

/// Whether derivatives of the modes of a study are known in closed form at all: of a mesh, solved
/// directly, with a basis that has eigenvectors.
bool has_modes_slopes(const Study& study);

/// By fe_modal::sensitivities(): one solution, and how nodes and materials change with each number,
/// which is the quotient of the differences between two meshes. A mode of a nearly equal pair has
/// its own derivative where the pair is uncoupled, else that of the pair's mean.
/// @param mesh     of the study
/// @param moved    differ from it in the mesh only
/// @param figures  of the modes, as modes_figure() has them
/// @pre a fe_modal::PetscSession
/// @throws InputError where a mesh of another topology comes out, and as modes_figure() does.
FigureSlopes modes_slopes(const Study& study, const mesher::Mesh& mesh, BodyUse use,
                          const std::vector<MovedStudy>& moved,
                          const std::vector<std::string>& figures, const Console& console);

}  // namespace flexneck::pipeline
