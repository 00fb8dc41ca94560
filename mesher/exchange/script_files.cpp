// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/script_files.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/input_file.h"

namespace flexneck::mesher {
namespace {

namespace fs = std::filesystem;

/// Commands whose argument is a file that is read.
constexpr std::array<std::string_view, 6> kReaders = {
    "Include", "Merge", "MergeWithBoundingBox", "Open", "ShapeFromFile", "ListFromFile"};

/// Words that may make a script depend on anything: commands, the environment, files of fields,
/// whose names are searched in several folders, plugins, some of which read files.
constexpr std::array<std::string_view, 9> kUnknown = {
    "System",          "SystemCall", "NonBlockingSystemCall",
    "OnelabRun",       "GetEnv",     "FileExists",
    "ExternalProcess", "FileName",   "Plugin"};

/// Endings of mesh and shape files, which are not searched for script commands; gmsh takes all
/// other files for scripts.
constexpr std::array<std::string_view, 15> kData = {".msh", ".stl",  ".step", ".stp",  ".brep",
                                                    ".igs", ".iges", ".unv",  ".bdf",  ".nas",
                                                    ".vtk", ".med",  ".mesh", ".cgns", ".inp"};

bool is_one_of(const auto& all, std::string_view word) {
  return std::find(all.begin(), all.end(), word) != all.end();
}

bool is_data(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return lower_case(c); });
  return is_one_of(kData, ending);
}

/// Tokens of a script: words, quoted texts and single marks, without comments.
class ScriptTokens {
 public:
  explicit ScriptTokens(std::string_view text) : rest_(text) {}

  /// The next token; empty at the end. A text keeps its first quote.
  std::string_view next() {
    skip_blanks();
    if (rest_.empty()) return {};
    if (rest_.front() == '"' || rest_.front() == '\'') {
      const std::string_view text = take(rest_.find(rest_.front(), 1));
      rest_.remove_prefix(std::min<std::size_t>(1, rest_.size()));
      return text;
    }
    const auto is_part = [](char c) { return is_letter_or_digit(c) || c == '_'; };
    const auto* const end = std::find_if_not(rest_.begin(), rest_.end(), is_part);
    return take(std::max<std::size_t>(1, static_cast<std::size_t>(end - rest_.begin())));
  }

 private:
  std::string_view take(std::size_t length) {
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  void skip_blanks() {
    for (;;) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n\f"), rest_.size()));
      if (rest_.starts_with("//")) {
        take(rest_.find('\n'));
      } else if (rest_.starts_with("/*")) {
        take(rest_.find("*/", 2));
        take(2);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
};

class Survey {
 public:
  void look_at(const fs::path& file) {
    if (!seen_.insert(file).second) return;
    note_read(file);
    std::error_code none;
    if (is_data(file) || !fs::is_regular_file(file, none)) return;
    const std::string text = text_of_file(file);
    ScriptTokens tokens(text);
    for (std::string_view word = tokens.next(); !word.empty(); word = tokens.next()) {
      if (is_one_of(kUnknown, word)) note_unknown_reads(file);
      if (!is_one_of(kReaders, word)) continue;
      std::string_view argument = tokens.next();
      if (argument == "(") argument = tokens.next();
      if (argument.starts_with('"') || argument.starts_with('\'')) {
        look_at(file.parent_path() / argument.substr(1));
      } else if (argument != "=") {  // a variable of this name
        note_unknown_reads(file);
      }
    }
  }

 private:
  std::set<fs::path> seen_;
};

}  // namespace

void note_script_files(const fs::path& script) {
  Survey survey;
  survey.look_at(script);
  survey.look_at(script.string() + ".opt");
}

}  // namespace flexneck::mesher
