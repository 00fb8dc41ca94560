// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/command_line.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/cli/command_reference.h"
#include "pipeline/process/wrapped_text.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace {

/// Adds an option that stands for a value of the study.
void add_setting(CLI::App& app, CommandLine& line, const char* name, const char* label,
                 const std::string& key, const std::string& help) {
  app.add_option_function<std::string>(
         name,
         [&line, key](const std::string& value) { line.settings.push_back(key + "=" + value); },
         help + "; same as --set " + key)
      ->option_text(label);
}

void add_folder(CLI::App& app, CommandLine& line) {
  app.add_option("-o,--out,--output", line.folder, "Folder for results")->option_text("DIR [out]");
}

void add_optional_folder(CLI::App& app, CommandLine& line) {
  line.folder.clear();
  app.add_option("-o,--out,--output", line.folder,
                 "Folder in which the result is written as a JSON file (default: none)")
      ->option_text("DIR")
      ->check([](const std::string& name) { return name.empty() ? "expected a folder" : ""; });
}

void add_settings(CLI::App& app, CommandLine& line) {
  app.add_option("--set", line.settings, "Set a key of the study or model, e.g. modes.count=12")
      ->option_text("KEY=VALUE ...")
      ->allow_extra_args(false);
}

void add_mesh_settings(CLI::App& app, CommandLine& line) {
  add_setting(app, line, "--preset", "NAME", "mesh.preset",
              "Preset of the mesh divisions: default or paper");
  add_setting(app, line, "--refine", "N", "mesh.refine",
              "Subdivide every element into N + 1 in each direction");
}

void add_modes_settings(CLI::App& app, CommandLine& line) {
  app.add_flag_function(
      "--check",
      [&line](std::int64_t /*times*/) { line.settings.emplace_back("modes.check=true"); },
      "Check that no mode is missing, and estimate the discretisation error");
  add_setting(app, line, "--solver", "NAME", "modes.solver",
              "Linear solver: automatic, cholmod (one process only) or mumps");
}

/// List of the names in TOML syntax.
std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return "[" + list + "]";
}

void add_cases(CLI::App& app, CommandLine& line) {
  app.add_option_function<std::vector<std::string>>(
         "--case",
         [&line](const std::vector<std::string>& names) {
           line.settings.push_back("cases=" + list_of(names));
         },
         "Run only this case; may be repeated, and NAME may end in *; same as --set cases")
      ->option_text("NAME ...")
      ->allow_extra_args(false);
}

void add_sensitivity(CLI::App& app, CommandLine& line) {
  app.add_flag("--sensitivity", line.sensitivity,
               "Compute sensitivities to all dimensions and material constants");
}

void add_redo(CLI::App& app, CommandLine& line) {
  app.add_flag("--force", line.redo, "Run all stages again, even if their inputs have not changed");
}

void add_keep(CLI::App& app, CommandLine& line) {
  app.add_flag("--keep", line.keep,
               "Store this study and these values in the results folder for later commands");
}

void add_show(CLI::App& app, CommandLine& line) {
  app.add_flag("--dry-run,--show", line.show,
               "Print the dimensions and a section of the neck without meshing");
}

void add_target(CLI::App& app, CommandLine& line) {
  app.add_option("--to", line.target,
                 "File to write; its extension sets the format (for an ISO-MME test TEST/TEST.mme)")
      ->option_text("FILE");
  app.add_flag("--binary", line.is_binary, "Write a binary instead of a text .msh file");
}

void add_curves(CLI::App& app, CommandLine& line) {
  CurveChoice& curves = line.curves;
  const auto add = [&](const char* name, std::string& value, const char* label, const char* help) {
    app.add_option(name, value, help)->option_text(label);
  };
  add("--channel", curves.channel, "NAME",
      "Column to rate, if the files have several; for ISO-MME tests the channel code");
  add("--reference-channel", curves.reference_channel, "NAME",
      "Column of the reference file, if its name differs");
  add("--unit", curves.unit, "UNIT", "Unit of the values of a file that gives no units");
  add("--from", curves.from, "TIME",
      "Start of the rated interval, e.g. '20 ms' (default: start of the common interval)");
  add("--to", curves.to, "TIME", "End of the rated interval (default: end of the common interval)");
}

void add_neck_loads(CLI::App& app, CommandLine& line) {
  NeckLoadChoice& loads = line.neck_loads;
  const auto add = [&](const char* name, std::string& value, const char* label, const char* help) {
    return app.add_option(name, value, help)->option_text(label);
  };
  add("--force", loads.force, "NAME", "Column of the axial force, tension positive")->required();
  add("--moment", loads.moment, "NAME", "Column of the moment My, flexion positive")->required();
  add("--shear", loads.shear, "NAME",
      "Column of the shear force Fx, if My was measured by a load cell above the condyles");
  add("--dummy", loads.dummy, "NAME [50th-male]",
      "Dummy that the intercepts apply to: 50th-male or 5th-female");
}

void add_shards(CLI::App& app, CommandLine& line) {
  app.add_option("--shard", line.shares.shard, "Compute only part I of N of the rows, e.g. 2/8")
      ->option_text("I/N");
}

void add_threads(CLI::App& app, CommandLine& line) {
  app.add_option("--threads", line.shares.threads,
                 "Maximum number of threads (default: all cores, 1 per MPI rank)")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
}

struct OptionRow {
  CommandOption option;
  void (*add)(CLI::App&, CommandLine&);
};
constexpr std::array<OptionRow, 15> kOptions = {
    {{CommandOption::folder, add_folder},
     {CommandOption::optional_folder, add_optional_folder},
     {CommandOption::curves, add_curves},
     {CommandOption::neck_loads, add_neck_loads},
     {CommandOption::shards, add_shards},
     {CommandOption::threads, add_threads},
     {CommandOption::settings, add_settings},
     {CommandOption::mesh_settings, add_mesh_settings},
     {CommandOption::modes_settings, add_modes_settings},
     {CommandOption::cases, add_cases},
     {CommandOption::sensitivity, add_sensitivity},
     {CommandOption::redo, add_redo},
     {CommandOption::keep, add_keep},
     {CommandOption::show, add_show},
     {CommandOption::target, add_target}}};

void describe(CLI::App& app, const Command& command, CommandLine& line) {
  app.add_option("files", line.files, command.files.help)->option_text(command.files.label);
  for (const OptionRow& row : kOptions) {
    if (std::count(command.options.begin(), command.options.end(), row.option) > 0)
      row.add(app, line);
  }
  CLI::Option* const quiet =
      app.add_flag("-q,--quiet", line.is_quiet, "Print errors and warnings only");
  app.add_flag("-v,--verbose", line.is_verbose, "Print all tables and the progress of each stage")
      ->excludes(quiet);
}

std::string help() {
  std::string text = fmt::format("flexneck: {}.\nUsage: {}\n\nCommands:\n", kPurpose, kUsage);
  for (const Command& command : commands())
    text += fmt::format("  {:<10}  {}\n", command.name, command.help);
  return text +
         "\n'flexneck COMMAND --help' lists the options of a command.\n'flexneck --version' prints "
         "the version and the commit that the program was built from.\n'flexneck --man' prints a "
         "manual page, 'flexneck --bash-completion' a bash completion script.\n" +
         kExitCodes;
}

/// Commands that have an option, such as "mesh, run".
std::string owners_of(const std::string& option) {
  std::string owners;
  for (const Command& command : commands()) {
    CommandLine unused;
    CLI::App app;
    describe(app, command, unused);
    if (app.get_option_no_throw(option) != nullptr)
      owners += (owners.empty() ? "" : ", ") + command.name;
  }
  return owners;
}

/// Text " (did you mean '--set'?)" for the first word that is no option of the command.
std::string near_option(const Command& command, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const OptionText& option : options_of(command))
    names.insert(names.end(), option.names.begin(), option.names.end());
  for (const std::string& word : words) {
    const std::string option = word.substr(0, word.find('='));
    if (!option.starts_with("--") || std::count(names.begin(), names.end(), option) > 0) continue;
    return did_you_mean(names, option);
  }
  return {};
}

[[noreturn]] void refuse(const CLI::App& app, const Command& command,
                         const std::vector<std::string>& words, const std::string& problem) {
  for (const std::string& word : words) {
    const std::string option = word.substr(0, word.find('='));
    if (!option.starts_with('-') || app.get_option_no_throw(option) != nullptr) continue;
    const std::string owners = owners_of(option);
    if (owners.empty()) continue;
    throw InputError(option + " is an option of the command " + owners + ", not of '" +
                     command.name + "'");
  }
  throw InputError(command.name + ": " + problem + near_option(command, words) + "; 'flexneck " +
                   command.name + " --help' lists its options");
}

/// Help of a command, whose options' texts are wrapped beside the column of their names.
std::string help_of(CLI::App& app) {
  constexpr std::size_t kNameColumns = 30;
  for (CLI::Option* const option : app.get_options())
    option->description(fmt::format(
        "{}",
        fmt::join(wrapped_lines(option->get_description(), kConsoleColumns - kNameColumns), "\n")));
  std::string text = app.help();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

void parse_options(const std::vector<std::string>& words, CommandLine& line) {
  const Command& command = *line.command;
  CLI::App app(command.help, "flexneck " + command.name);
  describe(app, command, line);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::CallForHelp&) {
    line.answer = help_of(app);
  } catch (const CLI::ParseError& error) {
    refuse(app, command, words, error.what());
  }
}

/// Index of the command in the words; the flags -q and -v may precede it.
std::size_t place_of_command(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 4> kFlags = {"-q", "--quiet", "-v", "--verbose"};
  const auto found = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(kFlags.begin(), kFlags.end(), word) == kFlags.end();
  });
  return static_cast<std::size_t>(found - words.begin());
}

[[noreturn]] void refuse_late_command(const std::vector<std::string>& words) {
  std::string name = "COMMAND";
  for (const std::string& word : words)
    for (const Command& command : commands())
      if (command.name == word) name = word;
  throw InputError("the command must precede its options and files: 'flexneck " + name +
                   "' followed by its options; found '" + words.front() +
                   "' first; 'flexneck --help' lists the commands");
}

}  // namespace

std::vector<OptionText> options_of(const Command& command) {
  CommandLine unused;
  CLI::App app;
  describe(app, command, unused);
  std::vector<OptionText> options;
  for (const CLI::Option* const option : app.get_options()) {
    if (!option->nonpositional()) continue;
    std::vector<std::string> names;
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    options.push_back({names, option->get_option_text(), option->get_description()});
  }
  return options;
}

CommandLine parse_command_line(const std::vector<std::string>& words) {
  CommandLine line;
  for (const std::string& word : words) line.text += (line.text.empty() ? "" : " ") + word;
  const std::vector<std::string> given(words.begin() + 1, words.end());
  const std::size_t place = place_of_command(given);
  const std::string first = place < given.size() ? given[place] : "";
  if (given.empty() || first == "-h" || first == "--help") {
    line.answer = help();
  } else if (first == "--version") {
    line.answer = std::string("flexneck ") + kVersion + " (" + kGitHash + ")";
  } else if (first == "--man") {
    line.answer = man_page();
  } else if (first == "--bash-completion") {
    line.answer = bash_completion();
  } else if (first.empty() || first.front() == '-') {
    refuse_late_command(given);
  } else {
    line.command = &commands()[find_name(names_of(commands()), first, "command")];
    std::vector<std::string> others = given;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(place));
    parse_options(others, line);
  }
  return line;
}

}  // namespace flexneck::pipeline
