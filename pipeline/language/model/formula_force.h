// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/forces/function_force.h"
#include "multibody/model/model.h"
#include "pipeline/language/model/state_expression.h"

namespace flexneck::pipeline {

/// A [[function_force]] as written in the file.
struct FormulaForce {
  std::string name;
  std::size_t marker_i = 0;  ///< index of the lower marker
  std::size_t marker_j = 0;  ///< index of the upper marker
  StateExpression::Texts texts;
  std::vector<double> breakpoints_s;
};

/// Makes the force. @throws InputError for an invalid formula.
multibody::FunctionForce function_force_of(const FormulaForce& force);

/// Returns the function forces of a model, in their order.
/// @throws InputError naming a force whose load is not given by formulas but by a function of a
/// program.
std::vector<FormulaForce> formula_forces_of(const multibody::Model& model);

}  // namespace flexneck::pipeline
