// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_cards.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/text_file.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

namespace fs = std::filesystem;

/// Fields between commas; a trailing comma has no field behind it.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

/// The name of a keyword or parameter; several blanks inside it count as one: "SOLID  SECTION".
std::string name_of(const std::string& text) {
  std::istringstream words(text);
  std::string name;
  for (std::string word; words >> word;) name += (name.empty() ? "" : " ") + word;
  return upper_case(name);
}

std::string unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

InpCard card_of(const InpPlace& place, const std::string& line) {
  InpCard card;
  card.place = place;
  const std::vector<std::string> fields = fields_of(line);
  card.keyword = name_of(fields.front().substr(1));
  for (std::size_t f = 1; f < fields.size(); ++f) {
    if (fields[f].empty()) continue;
    const std::size_t equals = fields[f].find('=');
    const std::string name = name_of(fields[f].substr(0, equals));
    const std::string value =
        equals == std::string::npos ? "" : unquoted(trimmed(fields[f].substr(equals + 1)));
    if (!card.parameters.emplace(name, value).second) card.refuse(name + " is given twice");
  }
  return card;
}

class Reader {
 public:
  explicit Reader(const fs::path& root) : folder_(fs::weakly_canonical(root).parent_path()) {}

  void read(const fs::path& file, const std::string& text) {
    std::istringstream lines(text);
    InpPlace place{file.string(), 0};
    std::string open_keyword;  // keyword line that a trailing comma continues
    InpPlace open_place;
    for (std::string raw; std::getline(lines, raw);) {
      ++place.line;
      const std::string line(trimmed(raw));
      if (line.empty() || line.starts_with("**")) continue;
      if (!open_keyword.empty() || line.front() == '*') {
        if (open_keyword.empty()) open_place = place;
        open_keyword += line;
        if (line.back() == ',') continue;
        add_card(card_of(open_place, open_keyword));
        open_keyword.clear();
      } else if (cards.empty()) {
        throw InputError(place.text() + "expected a keyword such as *NODE before any data");
      } else {
        cards.back().data.push_back({place, fields_of(line), line.back() == ','});
      }
    }
    if (!open_keyword.empty())
      throw InputError(open_place.text() + "the keyword line continues past the end of the file");
  }

  std::vector<InpCard> cards;

 private:
  void add_card(InpCard card) {
    if (card.keyword == "INCLUDE") {
      include(card);
    } else if (card.has("INPUT")) {
      card.refuse(
          "INPUT= is not supported; insert the lines of the file here, or write *INCLUDE, INPUT=" +
          card.parameters.at("INPUT") + " after the keyword line");
    } else {
      cards.push_back(std::move(card));
    }
  }

  void include(const InpCard& card) {
    constexpr std::size_t kDeepest = 8;
    constexpr std::size_t kMaxFiles = 1000;
    const std::string name = card.parameter("INPUT");
    if (card.parameters.size() > 1) card.refuse("only INPUT= is supported");
    std::error_code error;
    const fs::path file = fs::weakly_canonical(folder_ / name, error);
    if (error) card.refuse("INPUT=" + name + " cannot be read (" + error.message() + ")");
    const fs::path relative = file.lexically_relative(folder_);
    if (relative.empty() || *relative.begin() == "..") {
      card.refuse("INPUT=" + name + " lies outside the folder of the file; copy it there");
    }
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) card.refuse("there is no file " + name);
    if (++depth_ > kDeepest) card.refuse("files include each other more than 8 deep");
    if (++count_ > kMaxFiles) card.refuse("more than 1000 files are included");
    read(folder_ / relative, without_mark(text_of_file(file)));
    --depth_;
  }

  fs::path folder_;
  std::size_t depth_ = 0;
  std::size_t count_ = 0;
};

template <class Number>
bool parse(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

const std::string& field_of(const InpData& line, std::size_t field) {
  if (field >= line.fields.size()) {
    throw InputError(line.place.text() + "expected at least " + std::to_string(field + 1) +
                     " fields, found " + std::to_string(line.fields.size()));
  }
  return line.fields[field];
}

}  // namespace

std::string upper_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return flexneck::upper_case(c); });
  return result;
}

const std::string& InpCard::parameter(const std::string& name) const {
  const auto found = parameters.find(name);
  if (found == parameters.end() || found->second.empty()) refuse("expected " + name + "=…");
  return found->second;
}

void InpCard::refuse(const std::string& problem) const {
  throw InputError(place.text() + "*" + keyword + ": " + problem);
}

std::vector<InpCard> read_inp_cards(const fs::path& file, const std::string& text) {
  Reader reader(file);
  reader.read(file, text);
  return std::move(reader.cards);
}

std::int64_t inp_integer(const InpData& line, std::size_t field) {
  const std::string& text = field_of(line, field);
  std::int64_t number = 0;
  if (!parse(text, number)) {
    throw InputError(line.place.text() + "expected a whole number, found '" + text + "'");
  }
  return number;
}

double inp_number(const InpData& line, std::size_t field) {
  std::string text = field_of(line, field);
  std::replace(text.begin(), text.end(), 'D', 'E');  // Fortran's exponent
  std::replace(text.begin(), text.end(), 'd', 'e');
  double number = 0;
  if (!parse(text, number) || !std::isfinite(number)) {
    throw InputError(line.place.text() + "expected a number, found '" + text + "'");
  }
  return number;
}

}  // namespace flexneck::mesher
