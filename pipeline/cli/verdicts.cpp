// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/verdicts.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/cli/shown_tables.h"
#include "pipeline/experiments/test_curves.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/process/result_files.h"
#include "pipeline/results/tables/measured_tables.h"

namespace flexneck::pipeline {

namespace {

/// Reads the run of a case, if it exists and was made with the study's values.
std::optional<multibody::HistoryFile> run_of(const CommandInput& input,
                                             const std::string& experiment) {
  const Study& study = input.study;
  const CaseSection& section = study.cases[find_name(names_of(study.cases), experiment, "case")];
  const std::filesystem::path path = input.folder.history(section);
  if (!std::filesystem::exists(path)) return {};
  multibody::HistoryFile file = read_history(path);
  const std::string made_by =
      section.kind == CaseSection::Kind::pendulum ? "flexneck pendulum" : "flexneck static";
  require_same_inputs(path, file.provenance, study, case_provenance(study, section).parameters,
                      made_by);
  if (const std::string source = replaced_source(path, file.provenance); !source.empty())
    throw InputError(path.string() + ": was made from a different " + source +
                     " than the one in this folder; make it again with '" + made_by + "'");
  require_whole_run(path, file.history);
  return file;
}

JudgedTest judged_test(const CommandInput& input, const TestSection& test) {
  const Study& study = input.study;
  JudgedTest result;
  result.test = test;
  result.status = JudgedTest::Status::not_applicable;
  if (!applies(test, study)) return result;
  const CaseSection& experiment =
      study.cases[find_name(names_of(study.cases), test.experiment, "case")];
  result.status = JudgedTest::Status::not_run;
  const std::optional<multibody::HistoryFile> file = run_of(input, test.experiment);
  if (!file) return result;
  result.status = JudgedTest::Status::judged;
  result.verdict = judged(
      test.rules, test_curves(study, test, experiment, file->history.time_s, file->channels));
  result.moment_difference = moment_difference(test, experiment);
  return result;
}

}  // namespace

bool has_tests(const Study& study) { return !study.tests.empty() || !study.measured.empty(); }

namespace {

/// Tables of the tests with measured data, for which runs may be missing.
std::vector<ResultTable> measured_tables(const CommandInput& input) {
  std::vector<MeasuredRun> runs;
  for (const MeasuredTest& test : input.study.measured)
    runs.push_back({test, run_of(input, test.experiment)});
  std::vector<ResultTable> tables;
  const auto has = [&](const auto& of) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const MeasuredRun& run) { return !of(run.test).empty(); });
  };
  if (has([](const MeasuredTest& test) { return test.curves; }))
    tables.push_back(measured_curve_table(runs));
  if (has([](const MeasuredTest& test) { return test.corridors; }) ||
      has([](const MeasuredTest& test) { return test.limits; }))
    tables.push_back(measured_limit_table(runs));
  return tables;
}

}  // namespace

void write_verdicts(const CommandInput& input) {
  std::vector<JudgedTest> tests;
  tests.reserve(input.study.tests.size());
  for (const TestSection& test : input.study.tests) tests.push_back(judged_test(input, test));
  Provenance provenance = verdict_provenance(input.study);
  if (const std::filesystem::path modes = input.folder.modes(); std::filesystem::exists(modes))
    provenance.inputs.push_back({modes.filename().string(), hash_of_file(modes.string())});
  std::vector<ResultTable> tables;
  if (!tests.empty()) tables.push_back(verdict_table(tests, input.study));
  if (ResultTable figures = verdict_figure_table(tests); !figures.rows.empty())
    tables.push_back(std::move(figures));
  const std::vector<ResultTable> measured = measured_tables(input);
  tables.insert(tables.end(), measured.begin(), measured.end());
  write_tables(input.folder.file("verdicts.json"), tables, provenance);
  show_tables(input, tables);
  for (const std::string& warning : verdict_warnings(tests)) input.console.warning(warning);
}

}  // namespace flexneck::pipeline
