// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// Sets rows of text in columns: the first column aligned left, the others right unless named in
/// `left`. The first row is the head and is underlined. If the table is wider than the console,
/// left-aligned texts are wrapped, and columns that still do not fit follow below, repeating the
/// first column. No line break at the end.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& left = {0});

}  // namespace flexneck::pipeline
