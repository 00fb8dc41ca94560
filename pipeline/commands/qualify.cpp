// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "pipeline/commands/commands.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

namespace {

void require_regulation(const Study& study) {
  if (study.tests.empty())
    throw InputError(study.file.string() +
                     ": expected a [[test]] of a regulation to judge the neck by, found none");
}

}  // namespace

bool qualify_command(const CommandInput& input) {
  require_regulation(input.study);
  const bool passed = run_command(input);
  // With --verbose the run has shown them.
  if (!input.console.is_verbose())
    for (const ResultTable& table : read_tables(input.folder.file("verdicts.json")).tables)
      if (table.name == kVerdictFigures) input.console.result("\n" + printed(table));
  input.console.result(
      "\nA simulation certifies nothing: pulses are inside their corridors but those of no real "
      "test,\nand inputs are of the origins that 'flexneck study' tells.");
  return passed;
}

}  // namespace flexneck::pipeline
