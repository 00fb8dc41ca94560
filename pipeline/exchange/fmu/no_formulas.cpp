// SPDX-License-Identifier: GPL-3.0-or-later
// Part of the shared object without muParser, for models without formulas.
#include "geometry/foundation/error.h"
#include "pipeline/language/model/formula_force.h"

namespace flexneck::pipeline {

multibody::FunctionForce function_force_of(const FormulaForce& force) {
  throw InputError("function_force '" + force.name +
                   "': this shared library supports only models without formulas");
}

}  // namespace flexneck::pipeline
