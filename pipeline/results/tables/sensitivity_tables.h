// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fe_modal/analysis/sensitivity.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Name of a table with relative derivatives, a row for each input and a column for each quantity.
/// @param which 0: frequencies, 1: frequencies with bodies attached, 2: stiffness and mass
const char* relative_table_name(std::size_t which);
/// Name of the table with all derivatives, a row for each quantity and input.
inline constexpr const char* kSensitivityTable = "sensitivities";

/// True if a table is one of these.
bool is_of_sensitivities(const ResultTable& table);

/// The tables of sensitivities.json: those of relative derivatives that have a column, then the
/// complete list.
/// @param notes  general notes, such as the inputs left out
std::vector<ResultTable> sensitivity_tables(const fe_modal::Sensitivities& found,
                                            const std::vector<std::string>& notes);

/// Table of the first frequencies, the first one with a body attached and the mass, within the
/// console's width.
std::string short_sensitivities(const fe_modal::Sensitivities& found);

}  // namespace flexneck::pipeline
