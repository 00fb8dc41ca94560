// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/forces/function_force.h"
#include "multibody/model/model.h"
#include "pipeline/model/state_expression.h"

namespace flexneck::pipeline {

/// A [[function_force]] as it is written.
struct FormulaForce {
  std::string name;
  std::size_t marker_i = 0;  ///< the lower one
  std::size_t marker_j = 0;  ///< the upper one
  StateExpression::Texts texts;
  std::vector<double> breakpoints_s;
};

/// @throws InputError for a formula that cannot be read.
multibody::FunctionForce function_force_of(const FormulaForce& force);

/// The function forces of a model, in their order.
/// @throws InputError naming one whose load is not of formulas but a function of a program.
std::vector<FormulaForce> formula_forces_of(const multibody::Model& model);

}  // namespace flexneck::pipeline
