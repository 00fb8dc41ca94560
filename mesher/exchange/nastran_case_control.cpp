// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_case_control.h"

#include <charconv>

#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {

NastranCaseControl read_nastran_case_control(std::string_view text) {
  NastranCaseControl control;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const std::string words = upper_case(trimmed(*line));
    if (words.starts_with("BEGIN")) {
      control.is_given = true;
      return control;
    }
    const std::size_t equals = words.find('=');
    if (equals == std::string::npos) continue;
    const std::string name(trimmed(std::string_view(words).substr(0, equals)));
    const std::string value(trimmed(std::string_view(words).substr(equals + 1)));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc() && end == value.data() + value.size()) {
      control.sets[name].insert(number);
    }
  }
  return {};
}

}  // namespace flexneck::mesher
