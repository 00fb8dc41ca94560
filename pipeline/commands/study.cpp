// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/commands.h"
#include "pipeline/console/text_table.h"

namespace flexneck::pipeline {

bool study_command(const CommandInput& input) {
  std::vector<std::vector<std::string>> rows = {{"input", "value", "origin", "note"}};
  for (const Parameter& parameter : input.study.parameters) {
    rows.push_back(
        {parameter.key, parameter.value, std::string(name_of(parameter.origin)), parameter.note});
  }
  input.console.result(text_table(rows, {0, 1, 2, 3}));
  std::vector<std::vector<std::string>> defaults = {{"not given", "then"}};
  for (const Parameter& parameter : input.study.defaults)
    defaults.push_back({parameter.key, parameter.value});
  input.console.result("\n" + text_table(defaults, {0, 1}));
  return true;
}

}  // namespace flexneck::pipeline
