// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A table for the page. The first cell of a row is its head.
struct HtmlTable {
  struct Column {
    std::string title;       ///< plain text
    bool is_number = false;  ///< set to the right
    /// Of its numbers, which the page shows in either system of units: kOfRow where another column
    /// of the row names it; empty for none.
    std::string unit = {};
    bool names_unit = false;  ///< of the row
  };
  /// Cells are HTML: plain text has gone through html_text().
  struct Row {
    std::vector<std::string> cells;
    std::string attributes = {};  ///< of the <tr>, such as "data-origin=\"published\""
  };
  std::string caption;  ///< plain text
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::string name = {};  ///< for data-table, by which tests and scripts find it
};

/// For HtmlTable::Column::unit.
inline constexpr const char* kOfRow = "row";

/// In a box of its own that scrolls where the page is narrow.
std::string html_of(const HtmlTable& table);

/// "<ul>…</ul>" of plain texts; empty without any.
std::string html_list(const std::vector<std::string>& items);

}  // namespace flexneck::pipeline
