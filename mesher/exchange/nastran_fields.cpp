// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_fields.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_cards.h"

namespace flexneck::mesher {

void refuse_card(const NastranCard& card, const std::string& problem) {
  throw InputError("line " + std::to_string(card.line) + ": " + card.name + ": " + problem);
}

std::int64_t nastran_integer(const NastranCard& card, std::size_t field) {
  const std::string& text = card.field(field);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    refuse_card(card, "expected a whole number in field " + std::to_string(field + 2) +
                          ", found '" + text + "'");
  }
  return value;
}

std::int64_t nastran_integer_or(const NastranCard& card, std::size_t field, std::int64_t fallback) {
  return card.field(field).empty() ? fallback : nastran_integer(card, field);
}

double nastran_number(const NastranCard& card, std::size_t field, double fallback) {
  std::string text = card.field(field);
  if (text.empty()) return fallback;
  for (char& c : text) {
    if (c == 'D' || c == 'd' || c == 'E') c = 'e';
  }
  if (text.find('e') == std::string::npos) {
    const std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0) text.insert(sign, "e");
  }
  const std::string_view digits = std::string_view(text).substr(text.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    refuse_card(card, "expected a number in field " + std::to_string(field + 2) + ", found '" +
                          card.field(field) + "'");
  }
  return value;
}

std::array<bool, 6> nastran_components(const NastranCard& card, std::size_t field) {
  std::array<bool, 6> result{};
  for (const char c : card.field(field)) {
    if (c == '0') continue;
    if (c < '1' || c > '6') {
      refuse_card(card, "expected components from 1 to 6, found '" + card.field(field) + "'");
    }
    result[static_cast<std::size_t>(c - '1')] = true;
  }
  return result;
}

int nastran_component(const NastranCard& card, std::size_t field) {
  const std::int64_t value = nastran_integer_or(card, field, 0);
  if (value < 1 || value > 6) {
    refuse_card(card, "expected a component from 1 to 6, found '" + card.field(field) + "'");
  }
  return static_cast<int>(value);
}

std::vector<std::int64_t> nastran_list(const NastranCard& card, std::size_t field,
                                       const std::function<bool(std::int64_t)>& is_there) {
  constexpr std::int64_t kMost = 10'000'000;
  std::vector<std::int64_t> numbers;
  std::optional<std::int64_t> written;  // the last number, where a range may begin
  for (; field < card.fields.size(); ++field) {
    const std::string& text = card.field(field);
    if (text.empty()) continue;
    if (text.find('.') != std::string::npos) break;
    const bool is_range = upper_case(text) == "THRU";
    const std::int64_t number = nastran_integer(card, is_range ? ++field : field);
    if (is_range) {
      if (!written || number < *written || number - *written > kMost) {
        refuse_card(card, "expected a range with THRU");
      }
      for (std::int64_t next = *written + 1; next < number; ++next) {
        if (!is_there || is_there(next)) numbers.push_back(next);
      }
    }
    if (!is_there || is_there(number)) {
      numbers.push_back(number);
    } else if (!is_range && upper_case(card.field(field + 1)) != "THRU") {
      refuse_card(card, "there is no node " + text);
    }
    written = is_range ? std::nullopt : std::optional(number);
  }
  return numbers;
}

}  // namespace flexneck::mesher
