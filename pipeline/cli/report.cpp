// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/report.h"

#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

bool report_command(const CommandInput& input) {
  const std::filesystem::path page = input.folder.file("report.html");
  const Results results = read_results(page.parent_path(), input.study);
  if (results.files.empty() && results.warnings.empty()) refuse_without_results(page.parent_path());
  input.console.step("Writing the report");
  for (const std::string& warning : input.is_run ? results.warnings : results.all_warnings())
    input.console.warning(warning);
  write_report(page, results, input.study);
  input.console.result("\nReport: " + page.string());
  return true;
}

}  // namespace flexneck::pipeline
