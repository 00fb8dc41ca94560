// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/command_reference.h"

#include <vector>

#include "pipeline/cli/command_line.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace {

/// Escapes a line for troff: hyphens stay hyphens, and no leading character is taken for a request.
std::string troff(const std::string& text) {
  std::string line = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\') {
      line += "\\e";
    } else if (c == '-') {
      line += "\\-";
    } else {
      line += c;
    }
  }
  return line;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string option_entry(const OptionText& option) {
  return ".TP\n.B " +
         troff(joined(option.names, ", ") + (option.label.empty() ? "" : " ") + option.label) +
         "\n" + troff(option.help) + "\n";
}

std::string command_entry(const Command& command) {
  std::string text = ".SS \"" + troff(command.name + " [" + command.files.label + "]") + "\"\n" +
                     troff(command.help) + ".\n.br\n" + troff(command.files.label) + ": " +
                     troff(command.files.help) + ".\n";
  for (const OptionText& option : options_of(command)) text += option_entry(option);
  return text;
}

std::vector<std::string> names_of_options(const Command& command) {
  std::vector<std::string> names;
  for (const OptionText& option : options_of(command))
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

}  // namespace

std::string man_page() {
  std::string text = ".TH FLEXNECK 1 \"\" \"flexneck " + std::string(kVersion) +
                     "\" \"User Commands\"\n.SH NAME\nflexneck \\- " + troff(kPurpose) +
                     "\n.SH SYNOPSIS\n.B " + troff(kUsage) + "\n.SH COMMANDS\n";
  for (const Command& command : commands()) text += command_entry(command);
  text +=
      ".SH SHIPPED STUDIES AND MODELS\nA name without a path that is no file in the current "
      "folder is one of these, also where a file includes others:\n";
  return text + troff(joined(shipped_names(), ", ")) + ".\n.SH EXIT STATUS\n" + troff(kExitCodes) +
         "\n.SH FILES\n.I share/flexneck\nbeside the folder of the program: shipped studies, "
         "models, "
         "geometries and regulations\n";
}

std::string bash_completion() {
  std::string names;
  std::string cases;
  for (const Command& command : commands()) {
    names += (names.empty() ? "" : " ") + command.name;
    cases +=
        "    " + command.name + ") words='" + joined(names_of_options(command), " ") + "' ;;\n";
  }
  return "# SPDX-License-Identifier: GPL-3.0-or-later\n"
         "# bash completion of flexneck " +
         std::string(kVersion) +
         ", made by 'flexneck --bash-completion'.\n"
         "_flexneck() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} words= place\n"
         "  local commands='" +
         names +
         "'\n"
         "  local shipped='" +
         joined(shipped_names(), " ") +
         "'\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then words=\"$commands --help --version\"\n"
         "  elif [[ $word != -* ]]; then words=$shipped; fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  while IFS= read -r place; do COMPREPLY+=(\"$place\"); done < <(compgen -f -- "
         "\"$word\")\n"
         "}\n"
         "complete -o filenames -F _flexneck flexneck\n";
}

}  // namespace flexneck::pipeline
