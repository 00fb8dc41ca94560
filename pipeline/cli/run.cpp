// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>

#include <fmt/core.h>

#include "geometry/foundation/file_seconds.h"
#include "geometry/foundation/step_times.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/pendulum_cases.h"
#include "pipeline/cli/shown_tables.h"
#include "pipeline/cli/verdicts.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/result_table.h"
#include "pipeline/process/text_table.h"
#include "pipeline/run/stages.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Number of inputs of each origin: "published 12, inferred 5, …"
std::string origin_counts(const Study& study) {
  std::string text;
  for (std::size_t i = 0; i < kOriginNames.size(); ++i) {
    const auto count = std::count_if(
        study.parameters.begin(), study.parameters.end(),
        [&](const Parameter& parameter) { return parameter.origin == static_cast<Origin>(i); });
    text += (i > 0 ? ", " : "") + std::string(kOriginNames[i]) + " " + std::to_string(count);
  }
  return text;
}

/// Table of the inputs that are not synthetic, each with its origin; empty if all are.
std::string origin_table(const Study& study) {
  std::vector<std::vector<std::string>> rows = {{"input", "value", "origin"}};
  for (const Parameter& parameter : study.parameters) {
    if (parameter.origin == Origin::synthetic) continue;
    rows.push_back({parameter.key, parameter.value, std::string(name_of(parameter.origin))});
  }
  return rows.size() > 1 ? text_table(rows, {0, 1, 2}) : "";
}

constexpr const char* kModesStage = "modes";

/// A stage of `run`. A command that throws has not completed the stage; one that returns false has,
/// but its verification failed.
struct Stage {
  std::string name;
  Provenance from;
  std::vector<std::string> after;
  std::function<bool(const CommandInput&)> command;
};

/// Synchronises many ranks: the first one makes all stages; the others wait until it reaches the
/// modes, which all compute together, if they are due.
class ModesGate {
 public:
  explicit ModesGate(const fe_modal::Ranks& ranks) : ranks_(ranks) {}
  ~ModesGate() { tell(kNotDue); }
  ModesGate(const ModesGate&) = delete;
  ModesGate& operator=(const ModesGate&) = delete;

  /// Called by the first rank before it computes the modes.
  void open() { tell(kDue); }
  /// Called by the other ranks. @return true if the modes are to be computed
  static bool wait(const fe_modal::Ranks& ranks) { return ranks.of_first(kNotDue) == kDue; }

 private:
  static constexpr std::uint64_t kNotDue = 0;
  static constexpr std::uint64_t kDue = 1;

  void tell(std::uint64_t word) {
    if (!has_told_) static_cast<void>(ranks_.of_first(word));
    has_told_ = true;
  }

  fe_modal::Ranks ranks_;
  bool has_told_ = false;
};

/// Removes the study's own files from a provenance: they change with every value, and not every
/// value matters to a stage.
Provenance without_studies(Provenance provenance, const Study& study) {
  for (const InputFile& file : study.files) std::erase(provenance.inputs, file);
  return provenance;
}

bool has_cases(const Study& study, CaseSection::Kind kind) {
  return std::any_of(study.cases.begin(), study.cases.end(),
                     [&](const CaseSection& experiment) { return experiment.kind == kind; });
}

/// Stages before those of the single cases.
std::vector<Stage> stages_before_cases(const Study& study) {
  if (study.matrices) return {{kModesStage, provenance_of(study), {}, modes_command}};
  std::vector<Stage> stages = {{"mesh", mesh_provenance(study), {}, mesh_command},
                               {kModesStage, modes_provenance(study), {"mesh"}, modes_command},
                               {"pictures", {}, {"mesh", "modes"}, pictures_command}};
  if (has_cases(study, CaseSection::Kind::static_test)) {
    stages.push_back({"static",
                      experiment_provenance(study, CaseSection::Kind::static_test),
                      {"modes"},
                      static_command});
  }
  return stages;
}

std::string stage_of(const CaseSection& experiment) { return "pendulum-" + experiment.name; }

/// Stages that follow once every case of the pendulum has been run.
/// @param known results of the cases that were just run
std::vector<Stage> stages_after_cases(const Study& study, const PendulumResults& known) {
  const Provenance everything = verdict_provenance(study);
  std::vector<std::string> runs = {"modes"};
  for (const CaseSection* const experiment : pendulum_cases(study))
    runs.push_back(stage_of(*experiment));
  std::vector<std::string> results = runs;
  results.insert(results.end(), {"mesh", "pictures", "static", "pendulum", "verify"});
  std::vector<Stage> stages;
  if (has_cases(study, CaseSection::Kind::pendulum)) {
    stages.push_back({"pendulum", experiment_provenance(study, CaseSection::Kind::pendulum), runs,
                      [&known](const CommandInput& input) {
                        write_pendulum_tables(input, known);
                        return true;
                      }});
  }
  if (!study.verification.empty() || has_tests(study))
    stages.push_back({"verify", everything, runs, verify_command});
  if (!study.matrices) stages.push_back({"report", everything, results, report_command});
  return stages;
}

void print_kept(const CommandInput& input, const std::string& stage) {
  if (stage == "verify" && !input.study.verification.empty()) {
    const VerificationFile file = read_verification(input.folder.verification());
    show_verification(input, file.table);
  }
  if (stage == "report")
    input.console.result("\nReport: " + input.folder.file("report.html").string());
  const std::string name = stage == "verify" ? "verdicts" : stage;
  const fs::path tables = input.folder.file(name + ".json");
  if (!fs::exists(tables)) return;
  show_tables(input, read_tables(tables).tables);
}

/// Repeats the warnings of kept results, since they still apply.
void warn_again(const CommandInput& input, const Stages& records, const std::string& stage) {
  for (const std::string& line : records.warnings(stage)) input.console.warning(line);
}

void make(const CommandInput& input, Stages& records, const Stage& stage, ModesGate& gate) {
  const bool made =
      records.make(stage.name, without_studies(stage.from, input.study), stage.after, [&] {
        if (stage.name == kModesStage) gate.open();
        stage.command(input);
      });
  if (made) return;
  input.console.step("Inputs unchanged for " + stage.name + ": results kept");
  warn_again(input, records, stage.name);
  print_kept(input, stage.name);
}

/// Runs the cases of the pendulum, each of which is a stage. The stages that are due are determined
/// before the first is made, so that they can be computed ahead of their turn.
/// @return results of the cases that were run
PendulumResults make_cases(const CommandInput& input, Stages& records) {
  const std::vector<const CaseSection*> all = pendulum_cases(input.study);
  const auto from = [&](const CaseSection& experiment) {
    return without_studies(case_provenance(input.study, experiment), input.study);
  };
  std::vector<const CaseSection*> due;
  std::vector<std::string> kept;
  for (const CaseSection* const experiment : all)
    if (records.is_made(stage_of(*experiment), from(*experiment), {"modes"}))
      kept.push_back(stage_of(*experiment));
    else
      due.push_back(experiment);
  if (!kept.empty())
    input.console.step(fmt::format("Inputs unchanged for {} of {} pendulum cases: results kept",
                                   kept.size(), all.size()));
  for (const std::string& stage : kept) warn_again(input, records, stage);
  if (due.empty()) return {};
  PendulumCases cases(input, due);
  for (const CaseSection* const experiment : due)
    records.make(stage_of(*experiment), from(*experiment), {"modes"}, [&] { cases.write_next(); });
  return cases.results();
}

bool run_stages(const CommandInput& input, Stages& records, StepTimes& times) {
  const Study& study = input.study;
  ModesGate gate(input.ranks);
  input.console.result("Inputs by origin: " + origin_counts(study) + " (flexneck study)");
  if (const std::string table = origin_table(study); !table.empty()) input.console.table(table);
  const auto make_all = [&](const std::vector<Stage>& stages) {
    for (const Stage& stage : stages) {
      times.start(stage.name);
      make(input, records, stage, gate);
    }
  };
  make_all(stages_before_cases(study));
  times.start("pendulum cases");
  const PendulumResults known = make_cases(input, records);
  make_all(stages_after_cases(study, known));
  return study.verification.empty() ||
         read_verification(input.folder.verification()).table.passed();
}

}  // namespace

bool run_command(const CommandInput& alone) {
  if (!writes(alone)) {
    CommandInput input = alone;
    input.is_run = true;
    return !ModesGate::wait(input.ranks) || modes_command(input);
  }
  Stages records(alone.folder.path(), alone.redo);
  const Console console =
      alone.console.with_listener([&](const std::string& line) { records.add_warning(line); });
  const CommandInput input{.study = alone.study,
                           .folder = alone.folder,
                           .console = console,
                           .ranks = alone.ranks,
                           .redo = alone.redo,
                           .is_run = true,
                           .shares = alone.shares};
  input.folder.make();
  StepTimes times;
  const bool passed = run_stages(input, records, times);
  times.stop();
  const FileSeconds files = file_seconds();
  input.console.detail()(fmt::format("seconds: {}; of these hash of files {:.3f}, sync {:.3f}",
                                     times.summary(), files.hash, files.sync));
  return passed;
}

}  // namespace flexneck::pipeline
