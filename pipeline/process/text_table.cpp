// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/text_table.h"

#include <algorithm>

#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace {

constexpr std::size_t kGap = 2;         ///< spaces before each column
constexpr std::size_t kTextWidth = 48;  ///< width of a text column in a table that is too wide

using Cells = std::vector<std::string>;
using Columns = std::vector<std::size_t>;

bool contains(const Columns& columns, std::size_t column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

/// A row whose cells may have several lines each.
using Row = std::vector<Cells>;

Row row_of(const Cells& cells, const Columns& left, bool is_wrapped) {
  Row row;
  for (std::size_t c = 0; c < cells.size(); ++c)
    row.push_back(is_wrapped && contains(left, c) ? wrapped_lines(cells[c], kTextWidth)
                                                  : Cells{cells[c]});
  return row;
}

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c)
      for (const std::string& line : row[c]) widths[c] = std::max(widths[c], width_of(line));
  }
  return widths;
}

bool fits_console(const std::vector<std::size_t>& widths) {
  std::size_t total = 0;
  for (const std::size_t width : widths) total += kGap + width;
  return total <= kConsoleColumns;
}

/// Groups of columns that fit the console, each group behind the first column.
std::vector<Columns> blocks_of(const std::vector<std::size_t>& widths) {
  std::vector<Columns> blocks = {{}};
  std::size_t total = 0;
  for (std::size_t c = 0; c < widths.size(); ++c) {
    if (blocks.back().size() > 1 && total + kGap + widths[c] > kConsoleColumns) {
      blocks.push_back({0});
      total = kGap + widths[0];
    }
    blocks.back().push_back(c);
    total += kGap + widths[c];
  }
  return blocks;
}

std::string line_of(const Row& row, std::size_t line, const Columns& block, const Columns& left,
                    const std::vector<std::size_t>& widths) {
  std::string text;
  for (const std::size_t c : block) {
    if (c >= row.size()) continue;
    const std::string cell = line < row[c].size() ? row[c][line] : "";
    const std::string fill(widths[c] - width_of(cell), ' ');
    text += std::string(kGap, ' ') + (contains(left, c) ? cell + fill : fill + cell);
  }
  return text.erase(text.find_last_not_of(' ') + 1) + "\n";
}

std::string text_of(const std::vector<Row>& rows, const Columns& block, const Columns& left,
                    const std::vector<std::size_t>& widths) {
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::size_t lines = 1;
    for (const std::size_t c : block)
      if (c < rows[r].size()) lines = std::max(lines, rows[r][c].size());
    for (std::size_t line = 0; line < lines; ++line)
      text += line_of(rows[r], line, block, left, widths);
    if (r > 0) continue;
    for (const std::size_t c : block) text += std::string(kGap, ' ') + std::string(widths[c], '-');
    text += "\n";
  }
  return text;
}

}  // namespace

std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& left) {
  std::vector<Row> shown;
  std::vector<std::size_t> widths;
  for (const bool is_wrapped : {false, true}) {
    shown.clear();
    for (const Cells& cells : rows) shown.push_back(row_of(cells, left, is_wrapped));
    widths = widths_of(shown);
    if (fits_console(widths)) break;
  }
  std::string text;
  for (const Columns& block : blocks_of(widths))
    text += (text.empty() ? "" : "\n") + text_of(shown, block, left, widths);
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace flexneck::pipeline
