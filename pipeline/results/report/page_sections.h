// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "pipeline/results/report/html_table.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Converts a table of results to a table of the page.
HtmlTable html_table_of(const ResultTable& result);

/// The page's parts that are text and tables, as HTML, keyed by their names in page/report.html.
std::map<std::string, std::string> page_sections(const Results& results, const Study& study,
                                                 const std::vector<std::string>& paper_remarks);

}  // namespace flexneck::pipeline
