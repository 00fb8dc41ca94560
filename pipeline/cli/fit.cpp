// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/cli/commands.h"
#include "pipeline/parameter_studies/fit/fit_job.h"
#include "pipeline/parameter_studies/fit/fit_tables.h"
#include "pipeline/parameter_studies/fit/fitted_study.h"
#include "pipeline/parameter_studies/fit/uniqueness.h"
#include "pipeline/parameter_studies/sampling/interrupt.h"
#include "pipeline/process/wrapped_text.h"
#include "pipeline/results/report/fit_pictures.h"

namespace flexneck::pipeline {

namespace {

Provenance provenance_of_fit(const Study& study, const FitJob& job) {
  Provenance provenance = provenance_of(study.files, study.parameters);
  const std::vector<InputFile> files = input_files(job.files());
  provenance.inputs.insert(provenance.inputs.end(), files.begin(), files.end());
  return provenance;
}

/// Prints shortened tables that fit a terminal; with --verbose all tables in full.
void show(const CommandInput& input, const std::vector<ResultTable>& tables) {
  for (ResultTable table : tables) {
    const bool is_shown = table.name == "fit parameters" || table.name == "fit targets" ||
                          table.name == "fit history";
    if (!is_shown && !input.console.is_verbose()) continue;
    if (!input.console.is_verbose()) {
      const std::size_t columns = table.name == "fit parameters" ? 7 : 8;
      if (table.columns.size() > columns) table.columns.resize(columns);
      for (std::vector<std::string>& row : table.rows)
        if (row.size() > columns) row.resize(columns);
      table.notes.clear();
    }
    input.console.result("\n" + printed(table));
  }
}

/// Prints a line for each family that is as good as the best.
void show_families(const CommandInput& input, const StudyFit& fit, const FitResult& result) {
  for (std::size_t k = 0; k < result.families.size(); ++k) {
    const Family& family = result.families[k];
    if (!family.is_as_good) continue;
    std::string line = fmt::format("Family {} (starts: {}): chi-squared {:.3g}", k + 1,
                                   family.starts.size(), family.best.chi_squared);
    const Eigen::VectorXd at = fit.objective().parameters(family.best.place);
    for (std::size_t i = 0; i < fit.section().parameters.size(); ++i)
      line += fmt::format(", {} {:.4g} {}", fit.section().parameters[i].name,
                          at[static_cast<Eigen::Index>(i)], fit.section().parameters[i].unit);
    input.console.result(wrapped(line, ""));
  }
}

/// Removes pictures of an earlier fit, which may have had other targets.
void remove_former(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> former;
  for (const std::filesystem::directory_entry& each : std::filesystem::directory_iterator(folder))
    if (each.path().filename().string().starts_with("fit-") && each.path().extension() == ".svg")
      former.push_back(each.path());
  for (const std::filesystem::path& each : former) std::filesystem::remove(each);
}

/// Draws the pictures; the fit is valid without them, too.
void draw(const CommandInput& input, StudyFit& fit, const FitResult& result) {
  try {
    const std::vector<std::string> names = draw_fit(fit, result, input.folder.path());
    input.console.result(
        fmt::format("Pictures: {} of fit-*.svg in {}", names.size(), input.folder.path().string()));
  } catch (const InputError& error) {
    input.console.warning(std::string("the pictures of the fit cannot be drawn: ") + error.what());
  }
}

}  // namespace

bool fit_command(const CommandInput& input) {
  const unsigned threads = threads_of(input);
  const FilesRead reads;
  FitSection section = read_fit(input.study.file, input.study.settings);
  const std::vector<FileRead> targets = reads.files();
  const auto starts = static_cast<unsigned>(section.starts);
  Evaluator evaluator({input.study.file, input.study.settings}, input.console);
  const Interrupt interrupt;
  StudyFit fit(evaluator, std::move(section), std::max(1U, threads / starts));
  const std::filesystem::path& results = input.folder.path();
  input.console.step(
      fmt::format("Fit of {}: parameters: {}, targets: {}, starts: {}; derivatives {}; threads: {}",
                  input.study.file.string(), fit.section().parameters.size(), fit.targets().size(),
                  starts, fit.slopes_text(), threads));
  FitJob job(fit, results, targets, threads, &Interrupt::is_asked());
  FitResult result;
  try {
    result = job.run([&](const std::string& line) { input.console.step(line); });
  } catch (const FitStopped&) {
    throw ComputationError("stopped; completed fits are kept in " +
                           FitJob::folder(results).string() +
                           "; run the same command again to continue");
  }
  const std::vector<ResultTable> tables = fit_tables(fit, result);
  write_tables(input.folder.file("fit.json"), tables, provenance_of_fit(input.study, job));
  const std::filesystem::path fitted = input.folder.file("fitted.toml");
  write_text(fitted, fitted_study(fit, result, results));
  input.console.result(wrapped(verdict_of_fit(fit.objective(), result), ""));
  show_families(input, fit, result);
  show(input, tables);
  input.console.result("\n" + wrapped(choices_text(fit.section()), ""));
  input.console.result("Fitted study: " + fitted.string());
  remove_former(results);
  draw(input, fit, result);
  return true;
}

}  // namespace flexneck::pipeline
