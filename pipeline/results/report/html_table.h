// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A table for the page. The first cell of a row is its head.
struct HtmlTable {
  struct Column {
    std::string title;       ///< plain text
    bool is_number = false;  ///< aligned right
    /// Unit of the column's numbers, which the page shows in either system: kOfRow if another
    /// column of the row names it; empty for none.
    std::string unit = {};
    bool names_unit = false;  ///< contains the unit of its row
  };
  /// Cells are HTML: plain text must have passed through html_text().
  struct Row {
    std::vector<std::string> cells;
    std::string attributes = {};  ///< attributes of the <tr>, such as "data-origin=\"published\""
  };
  std::string caption;  ///< plain text
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::string name = {};  ///< value of data-table, for tests and scripts
};

/// Value of HtmlTable::Column::unit for a unit given in the row.
inline constexpr const char* kOfRow = "row";

/// HTML of a table in a box of its own that scrolls if the page is narrow.
std::string html_of(const HtmlTable& table);

/// HTML list "<ul>…</ul>" of plain texts; empty without any.
std::string html_list(const std::vector<std::string>& items);

}  // namespace flexneck::pipeline
