// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// Rows of text set in columns: the first column to the left, the others to the right unless named
/// in `left`. The first row is the head and gets a line below it. In a table that is wider than the
/// console, texts to the left take several lines, and columns that still do not fit follow below,
/// each time behind the first one. No line break at the end.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& left = {0});

}  // namespace flexneck::pipeline
