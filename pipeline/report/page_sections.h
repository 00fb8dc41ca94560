// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "pipeline/report/html_table.h"
#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// A table of results for the page.
HtmlTable html_table_of(const ResultTable& result);

/// The parts of the page that are text and tables, as HTML, by the names that page/report.html has
/// for them.
std::map<std::string, std::string> page_sections(const Results& results, const Study& study,
                                                 const std::vector<std::string>& paper_remarks);

}  // namespace flexneck::pipeline
