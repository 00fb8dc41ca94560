// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/verdicts.h"

#include <set>

#include "geometry/foundation/names.h"
#include "pipeline/commands/shown_tables.h"
#include "pipeline/experiments/test_curves.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/isolation/result_files.h"

namespace flexneck::pipeline {

namespace {

JudgedTest judged_test(const CommandInput& input, const TestSection& test) {
  const Study& study = input.study;
  JudgedTest result;
  result.test = test;
  result.status = JudgedTest::Status::not_applicable;
  if (!applies(test, study)) return result;
  const CaseSection& experiment =
      study.cases[find_name(names_of(study.cases), test.experiment, "case")];
  const std::filesystem::path path = input.folder.history(experiment);
  result.status = JudgedTest::Status::not_run;
  if (!std::filesystem::exists(path)) return result;
  const multibody::HistoryFile file = read_history(path);
  require_same_inputs(path, file.provenance, study, case_provenance(study, experiment).parameters,
                      "flexneck pendulum");
  require_whole_run(path, file.history);
  result.status = JudgedTest::Status::judged;
  result.verdict =
      judged(test.rules, test_curves(study, test, experiment, file.history.time_s, file.channels));
  result.moment_difference = moment_difference(test, experiment);
  return result;
}

}  // namespace

std::vector<InputFile> regulation_files(const Study& study) {
  std::set<std::filesystem::path> paths;
  for (const TestSection& test : study.tests) paths.insert(test.file);
  std::vector<InputFile> files;
  files.reserve(paths.size());
  for (const std::filesystem::path& path : paths)
    files.push_back({path.filename().string(), hash_of_file(path.string())});
  return files;
}

void write_verdicts(const CommandInput& input) {
  std::vector<JudgedTest> tests;
  tests.reserve(input.study.tests.size());
  for (const TestSection& test : input.study.tests) tests.push_back(judged_test(input, test));
  Provenance provenance = provenance_of(input.study);
  const std::vector<InputFile> regulations = regulation_files(input.study);
  provenance.inputs.insert(provenance.inputs.end(), regulations.begin(), regulations.end());
  std::vector<ResultTable> tables = {verdict_table(tests, input.study)};
  if (ResultTable figures = verdict_figure_table(tests); !figures.rows.empty())
    tables.push_back(std::move(figures));
  write_tables(input.folder.file("verdicts.json"), tables, provenance);
  show_tables(input, tables);
  for (const std::string& warning : verdict_warnings(tests)) input.console.warning(warning);
}

}  // namespace flexneck::pipeline
