// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fe_modal/analysis/sensitivity.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

/// Name of a table with relative derivatives, a row for each input and a column for each quantity.
/// @param which 0: of frequencies, 1: of those with bodies attached, 2: of stiffness and mass
const char* relative_table_name(std::size_t which);
/// Name of the table with all derivatives, a row for each quantity and input.
inline constexpr const char* kSensitivityTable = "sensitivities";

/// Whether a table is one of these.
bool is_of_sensitivities(const ResultTable& table);

/// The tables of sensitivities.json: those of relative derivatives that have a column, then the
/// list of all.
/// @param notes  on the whole, such as what is left out
std::vector<ResultTable> sensitivity_tables(const fe_modal::Sensitivities& found,
                                            const std::vector<std::string>& notes);

/// The first frequencies, the first one with a body attached and the mass, within the console.
std::string short_sensitivities(const fe_modal::Sensitivities& found);

}  // namespace flexneck::pipeline
