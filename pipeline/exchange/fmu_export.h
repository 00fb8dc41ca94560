// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/language/model/model_file.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// Writes a model as an FMU 3.0 for co-simulation (manual/guides/exchange.md).
/// @param console  takes a warning for each channel whose filter is left out
/// @throws InputError naming a load that is a function of a program, or two variables of one name.
void write_fmu(const ModelFile& file, const std::filesystem::path& target, const Console& console);

}  // namespace flexneck::pipeline
