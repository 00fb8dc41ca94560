// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/analysis/sensitivity.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/console/console.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A dimension without a derivative.
struct LeftOutParameter {
  std::string key;
  std::string why;
  bool is_choice = false;  ///< it is there to choose nodes, so that nothing is amiss
};

/// What a study makes its structure from, as far as there are derivatives by it.
struct StudyParameters {
  /// By their keys: the neck's dimensions or the script's constants, then the constants of the
  /// materials.
  std::vector<fe_modal::DesignParameter> parameters;
  std::vector<LeftOutParameter> left_out;
  int script_runs = 0;
};

/// Runs the script a little below and above each of its numbers, for how the nodes move. Left out
/// is what moves no node, such as a choice of nodes, and what changes the topology, such as a
/// number of divisions. A mesh from a file has materials only.
/// @param mesh of the study
StudyParameters design_parameters(const Study& study, const mesher::Mesh& mesh,
                                  const Console& console);

}  // namespace flexneck::pipeline
