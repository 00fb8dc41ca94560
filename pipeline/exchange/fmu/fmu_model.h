// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "multibody/equations/solver_options.h"
#include "multibody/model/model.h"
#include "multibody/simulation/stepped_run.h"
#include "pipeline/language/model/channel.h"
#include "pipeline/language/model/formula_force.h"

namespace flexneck::pipeline {

/// Content of an FMU: all that its shared object needs to run a model.
struct FmuModel {
  multibody::Model model;
  multibody::SolverOptions solver;
  multibody::SteppedRun::Kind kind = multibody::SteppedRun::Kind::motion;
  double end_time_s = 1;
  double interval_s = 1e-3;
  std::vector<ChannelSpec> channels;  ///< without filters, which need the whole run
};

/// Bytes of a model.
/// @param formulas  formulas of the model's function forces, formula_forces_of()
std::string bytes_of(const FmuModel& fmu, std::vector<FormulaForce> formulas);
/// The instantiation token of a model's bytes: their hash in braces.
std::string token_of(const std::string& bytes);
/// Reads a model. @throws InputError for bytes that are damaged or of another version.
FmuModel fmu_model_of(std::string_view bytes);

enum class Causality { independent, parameter, input, output };

/// A variable, whose value reference is its index among all.
struct FmuVariable {
  std::string name;
  Causality causality;
  std::string unit;
  std::string what;
  double start = 0;  ///< start value of parameters and inputs
};

/// All variables: time; the parameters, which are members of the model; the inputs of inputs_of();
/// one for each component of the channels.
std::vector<FmuVariable> variables_of(FmuModel& fmu);
/// Pointers to the members of the model that are parameters, in their order.
std::vector<double*> parameters_of(multibody::Model& model);

}  // namespace flexneck::pipeline
