// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/formula_force.h"

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

multibody::FunctionForce function_force_of(const FormulaForce& force) {
  const StateExpression load(force.texts);
  return {force.name,         force.marker_i, force.marker_j, load, load.takes_rotation_vector(),
          force.breakpoints_s};
}

std::vector<FormulaForce> formula_forces_of(const multibody::Model& model) {
  std::vector<FormulaForce> forces;
  for (const multibody::FunctionForce& each : model.forces.of<multibody::FunctionForce>()) {
    const auto* const load = each.load.target<StateExpression>();
    if (load == nullptr)
      throw InputError(
          title(each) +
          ": its load is a function of a program, which cannot be written as a formula");
    forces.push_back({each.name, each.marker_i, each.marker_j, load->texts(), each.breakpoints_s});
  }
  return forces;
}

}  // namespace flexneck::pipeline
