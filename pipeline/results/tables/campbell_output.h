// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "multibody/analysis/campbell.h"

namespace flexneck::pipeline {

/// Writes the diagram as a table: a line for each rate, with frequency, damping ratio and growth
/// rate of each mode.
/// @throws InputError if the file cannot be written.
void write_campbell_table(const std::filesystem::path& path,
                          const multibody::CampbellDiagram& diagram);

/// Draws the frequencies over the rate by gnuplot as SVG, with the line of one per revolution.
/// @throws InputError if gnuplot is missing or the file cannot be written.
void draw_campbell(const std::filesystem::path& path, const multibody::CampbellDiagram& diagram);

}  // namespace flexneck::pipeline
