// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/console/text_table.h"

#include <algorithm>

namespace flexneck::pipeline {

namespace {

/// Characters as they appear: the continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& left) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], width_of(row[c]));
    }
  }
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line = "  ";
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const std::string fill(widths[c] - width_of(rows[r][c]), ' ');
      const bool to_left = std::find(left.begin(), left.end(), c) != left.end();
      line += (c > 0 ? "  " : "") + (to_left ? rows[r][c] + fill : fill + rows[r][c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += (r > 0 ? "\n" : "") + line;
    if (r == 0) {
      text += "\n  ";
      for (std::size_t c = 0; c < widths.size(); ++c) {
        text += std::string(c > 0 ? 2 : 0, ' ') + std::string(widths[c], '-');
      }
    }
  }
  return text;
}

}  // namespace flexneck::pipeline
