// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/analysis/sensitivity.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// A dimension without a derivative.
struct LeftOutParameter {
  std::string key;
  std::string why;
  bool is_choice = false;  ///< the dimension only selects nodes, so leaving it out needs no warning
};

/// Parameters of a study's structure by which there are derivatives.
struct StudyParameters {
  /// Parameters named by their keys: the neck's dimensions or the script's constants, then the
  /// constants of the materials.
  std::vector<fe_modal::DesignParameter> parameters;
  std::vector<LeftOutParameter> left_out;
  int script_runs = 0;
};

/// Runs the script with each of its numbers a little lower and higher to find the velocities of the
/// nodes. Parameters that move no node, such as a choice of nodes, and those that change the
/// topology, such as a number of divisions, are left out. A mesh from a file has materials only.
/// @param mesh mesh of the study
StudyParameters design_parameters(const Study& study, const mesher::Mesh& mesh,
                                  const Console& console);

}  // namespace flexneck::pipeline
