// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "pipeline/language/study/study.h"
#include "pipeline/parameter_studies/evaluation/structure_modes.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// A study with one number slightly changed.
struct MovedStudy {
  Study study;
  double width = 0;  ///< signed change of the number
};

/// Figures of the modes and their derivatives by the changed numbers.
struct FigureSlopes {
  Eigen::VectorXd values;       ///< (n) SI
  Eigen::MatrixXd derivatives;  ///< (n, p)
};

/// Returns whether two studies differ, as far as modes go, only in values of the mesh: dimensions
/// or material constants. Derivatives by such values are known in closed form.
bool differ_in_mesh_only(const Study& a, const Study& b);

/// Returns whether derivatives of a study's modes are known in closed form at all: for a mesh,
/// solved directly, with a basis that has eigenvectors.
bool has_modes_slopes(const Study& study);

/// Derivatives by fe_modal::sensitivities(): from one solution and the rates at which nodes and
/// materials change with each number, found as difference quotients between two meshes. A mode of a
/// nearly equal pair has its own derivative if the pair is uncoupled, else that of the pair's mean.
/// @param mesh     mesh of the study
/// @param moved    studies that differ from it in the mesh only
/// @param figures  names of figures of the modes, as for modes_figure()
/// @pre a fe_modal::PetscSession
/// @throws InputError if a changed mesh has another topology, and as modes_figure() does.
FigureSlopes modes_slopes(const Study& study, const mesher::Mesh& mesh, BodyUse use,
                          const std::vector<MovedStudy>& moved,
                          const std::vector<std::string>& figures, const Console& console);

}  // namespace flexneck::pipeline
