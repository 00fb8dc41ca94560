// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/exchange/mme_codes.h"
#include "pipeline/laboratory/iso_mme/test_writer.h"
#include "pipeline/process/result_files.h"
#include "pipeline/process/result_table.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

bool is_of_a_case(const multibody::HistoryFile& run) {
  const auto& parameters = run.provenance.parameters;
  return std::any_of(parameters.begin(), parameters.end(),
                     [](const Parameter& each) { return each.key.starts_with("case."); });
}

/// The study that made the folder of a run.
Study study_of(const fs::path& folder) {
  const StudyChoice choice = remembered_study(folder).value_or(StudyChoice());
  return read_study(choice.study.empty() ? built_in_study() : choice.study, choice.settings);
}

const CaseSection& case_of(const Study& study, const fs::path& file) {
  const ResultsFolder folder(file.parent_path());
  for (const CaseSection& each : study.cases)
    if (folder.history(each).filename() == file.filename()) return each;
  throw InputError(
      file.string() +
      ": the study of this folder no longer contains this case; make it again with 'flexneck run'");
}

std::string type_of(const MmeSource& source) {
  if (source.experiment == nullptr) return "simulation";
  return source.experiment->kind == CaseSection::Kind::static_test ? "static neck test"
                                                                   : "head/neck pendulum";
}

std::vector<std::string> comments_on(const multibody::HistoryFile& run, const MmeSource& source) {
  std::vector<std::string> comments = {"computed by " + run.provenance.program + ", not measured"};
  if (source.experiment != nullptr)
    comments.emplace_back(
        "direction 1 or 2: the sign differs from that of SAE J211; rotations are positive towards "
        "the side to which the head tips");
  return comments;
}

ResultTable table_of(const MmeTest& test, const std::string& name) {
  ResultTable table = {"iso-mme",
                       "Channels of the test " + name,
                       {{"file", ""}, {"code", ""}, {"channel", ""}, {"unit", ""}},
                       {},
                       {}};
  for (const MmeChannel& channel : test.channels)
    table.rows.push_back(
        {fmt::format(".{:03}", table.rows.size() + 1), channel.code, channel.name, channel.unit});
  return table;
}

}  // namespace

void export_mme_test(const FileInput& input) {
  const fs::path& file = input.files.front();
  const multibody::HistoryFile run = read_history(file);
  require_whole_run(file, run.history);
  MmeSource source;
  std::optional<Study> study;
  if (is_of_a_case(run)) {
    study = study_of(file.parent_path());
    source = {&case_of(*study, file), study->dummy};
    require_same_inputs(file, run.provenance, *study, {}, "flexneck run");
  }
  std::vector<std::string> left_out;
  const MmeTest test = {file.stem().string(), type_of(source), source.dummy,
                        comments_on(run, source), mme_channels(run, source, left_out)};
  write_mme_test(input.target, test);
  for (const std::string& line : left_out) input.console.warning(file.string() + ": " + line);
  input.console.result(printed(table_of(test, input.target.stem().string())));
}

}  // namespace flexneck::pipeline
