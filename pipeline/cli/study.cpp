// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/commands.h"
#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

bool study_command(const CommandInput& input) {
  std::string given;
  for (const Parameter& parameter : input.study.parameters) {
    given += wrapped(parameter.key + " = " + parameter.value + "  (" +
                         std::string(name_of(parameter.origin)) + ")",
                     "  ");
    if (!parameter.note.empty()) given += wrapped(parameter.note, "      ");
  }
  std::string fallbacks;
  for (const Parameter& parameter : input.study.defaults)
    fallbacks += wrapped(parameter.key + " = " + parameter.value, "  ");
  input.console.result("Given values and their origin:\n" + given +
                       "\nDefault values of keys that are not given:\n" + fallbacks);
  return true;
}

}  // namespace flexneck::pipeline
