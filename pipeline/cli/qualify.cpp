// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/cli/commands.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/process/result_table.h"
#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace {

void require_regulation(const Study& study) {
  if (study.tests.empty())
    throw InputError(study.file.string() +
                     ": expected a [[test]] of a regulation to evaluate the neck, found none");
}

/// Origins of the decelerations of the judged cases: "certification-flexion: synthetic; …".
std::string pulse_origins(const Study& study) {
  std::string text;
  for (const TestSection& test : study.tests) {
    const CaseSection& experiment =
        study.cases[find_name(names_of(study.cases), test.experiment, "case")];
    const std::string key = "pulse." + experiment.pulse + ".deceleration";
    const auto found =
        std::find_if(study.parameters.begin(), study.parameters.end(),
                     [&](const Parameter& parameter) { return parameter.key == key; });
    text += (text.empty() ? "" : "; ") + experiment.name + ": " +
            (found == study.parameters.end() ? "from a file" : std::string(name_of(found->origin)));
  }
  return text;
}

}  // namespace

bool qualify_command(const CommandInput& input) {
  require_regulation(input.study);
  const bool passed = run_command(input);
  if (!writes(input)) return passed;
  // With --verbose the run has already shown these tables.
  if (!input.console.is_verbose())
    for (const ResultTable& table : read_tables(input.folder.file("verdicts.json")).tables)
      if (table.name == kVerdictFigures) input.console.result("\n" + printed(table));
  input.console.result("\n" +
                       wrapped("A simulation does not certify a neck. Origin of the pulses: " +
                                   pulse_origins(input.study) +
                                   ". 'flexneck study' prints the origin of every input.",
                               ""));
  return passed;
}

}  // namespace flexneck::pipeline
