// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/fmu/fmu_model.h"

namespace flexneck::pipeline {

/// What modelDescription.xml says besides the variables.
struct FmuDescription {
  std::string name;        ///< of the model
  std::string identifier;  ///< of the shared object, a name in C
  std::string token;       ///< which the shared object gets to see again
  std::string tool;        ///< that made the FMU
  std::string about = {};  ///< may be empty
};

/// The file modelDescription.xml of FMI 3.0, for co-simulation.
std::string model_description(const FmuDescription& description, FmuModel& fmu);

/// A name in C made of any text.
std::string c_identifier(const std::string& name);

}  // namespace flexneck::pipeline
