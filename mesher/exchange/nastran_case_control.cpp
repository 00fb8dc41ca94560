// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_case_control.h"

#include <charconv>
#include <vector>

#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

/// A command "SPC = 1", or "SPC 1": a word in capitals and its value.
struct Command {
  std::string word;
  std::string value;
};

Command command_of(std::string_view line) {
  const std::string text = upper_case(trimmed(line));
  const std::size_t end = text.find_first_of("= \t");
  if (end == std::string::npos) return {text, {}};
  std::string_view value = trimmed(std::string_view(text).substr(end));
  if (value.starts_with('=')) value = trimmed(value.substr(1));
  return {text.substr(0, end), std::string(value)};
}

std::string set_text(std::optional<std::int64_t> set) {
  return set ? std::to_string(*set) : std::string("none");
}

class CaseReader {
 public:
  CaseReader(LeftOut& left_out) : left_out_(left_out) {}

  void read(std::string_view line, std::size_t number) {
    const auto refuse = [&](const std::string& problem) {
      throw InputError("line " + std::to_string(number) + ": " + problem);
    };
    const auto [word, value] = command_of(line);
    if (word == "INCLUDE") refuse("INCLUDE is not supported; write the deck as a single file");
    if (word == "K2GG" || word == "M2GG" || word == "K2PP" || word == "M2PP") {
      refuse(word + ": matrices selected in case control are not supported");
    }
    if (word.starts_with("SUBC")) cases_.push_back({value, above_});
    if (word.starts_with("STATSUB")) {
      left_out_.remark("the prestress of STATSUB: modes are those of the unloaded structure");
    }
    if (word != "SPC" && word != "MPC") return;
    std::int64_t set = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), set);
    if (error != std::errc() || end != value.data() + value.size()) {
      refuse(word + ": expected the number of a set, found '" + value + "'");
    }
    (cases_.empty() ? above_ : cases_.back().sets)[word] = set;
  }

  /// Returns the selected sets. A subcase inherits the lines above the subcases, unless it
  /// overrides them.
  NastranCaseControl finish() const {
    NastranCaseControl control{true, cases_.empty() ? above_ : cases_.front().sets};
    for (const char* const word : {"SPC", "MPC"}) {
      for (const Subcase& other : cases_) {
        const auto one = set_of(cases_.front(), word);
        const auto two = set_of(other, word);
        if (one == two) continue;
        throw InputError("SUBCASE " + cases_.front().name + " has " + word + " = " + set_text(one) +
                         ", SUBCASE " + other.name + " has " + word + " = " + set_text(two) +
                         "; each has its own modes; keep only one of the subcases");
      }
    }
    return control;
  }

 private:
  using Sets = std::map<std::string, std::int64_t>;
  struct Subcase {
    std::string name;
    Sets sets;
  };
  static std::optional<std::int64_t> set_of(const Subcase& subcase, const std::string& word) {
    const auto found = subcase.sets.find(word);
    if (found == subcase.sets.end()) return std::nullopt;
    return found->second;
  }

  LeftOut& left_out_;
  Sets above_;
  std::vector<Subcase> cases_;
};

}  // namespace

NastranCaseControl read_nastran_case_control(std::string_view text, LeftOut& left_out) {
  const std::size_t bulk = nastran_bulk_line(text);
  if (bulk == 0) return {};
  CaseReader reader(left_out);
  TextLines lines(text);
  while (const auto line = lines.next()) {
    if (lines.number() == bulk) break;
    reader.read(without_comment(*line), lines.number());
  }
  return reader.finish();
}

}  // namespace flexneck::mesher
