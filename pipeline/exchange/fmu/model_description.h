// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/exchange/fmu/fmu_model.h"

namespace flexneck::pipeline {

/// Content of modelDescription.xml besides the variables.
struct FmuDescription {
  std::string name;        ///< name of the model
  std::string identifier;  ///< name of the shared object, an identifier in C
  std::string token;       ///< instantiation token, which is passed back to the shared object
  std::string tool;        ///< name of the program that made the FMU
  std::string about = {};  ///< may be empty
};

/// Text of the file modelDescription.xml of FMI 3.0, for co-simulation.
std::string model_description(const FmuDescription& description, FmuModel& fmu);

/// Converts any text to an identifier in C.
std::string c_identifier(const std::string& name);

}  // namespace flexneck::pipeline
