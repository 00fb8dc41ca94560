// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/html_table.h"

#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/display_units.h"

namespace flexneck::pipeline {

namespace {

std::string head_of(const HtmlTable::Column& column) {
  std::string html =
      std::string("<th scope=\"col\"") + (column.is_number ? " class=\"number\"" : "");
  if (!column.unit.empty()) html += " data-unit=\"" + html_text(column.unit) + "\"";
  if (column.names_unit) html += " data-names-unit";
  html += ">" + html_text(column.title);
  if (!column.unit.empty() && column.unit != kOfRow)
    html += " (<span class=\"unit\">" + html_text(unit_label(column.unit)) + "</span>)";
  return html + "</th>";
}

std::string cell_of(const HtmlTable& table, const HtmlTable::Row& row, std::size_t c) {
  const std::string kind = table.columns[c].is_number ? " class=\"number\"" : "";
  return c == 0 ? "<th scope=\"row\"" + kind + ">" + row.cells[c] + "</th>"
                : "<td" + kind + ">" + row.cells[c] + "</td>";
}

}  // namespace

std::string html_of(const HtmlTable& table) {
  const std::string caption = html_text(table.caption);
  std::string html = "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"" + caption +
                     "\">\n<table data-table=\"" + html_text(table.name) + "\">\n<caption>" +
                     caption + "</caption>\n<thead><tr>";
  for (const HtmlTable::Column& column : table.columns) html += head_of(column);
  html += "</tr></thead>\n<tbody>\n";
  for (const HtmlTable::Row& row : table.rows) {
    html += "<tr" + (row.attributes.empty() ? "" : " " + row.attributes) + ">";
    for (std::size_t c = 0; c < row.cells.size() && c < table.columns.size(); ++c) {
      html += cell_of(table, row, c);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string html_list(const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string html = "<ul>\n";
  for (const std::string& item : items) html += "<li>" + html_text(item) + "</li>\n";
  return html + "</ul>\n";
}

}  // namespace flexneck::pipeline
