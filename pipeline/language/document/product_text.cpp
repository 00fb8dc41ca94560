// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/product_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"

namespace flexneck::pipeline {

namespace {

constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

bool is_in_name(char c) { return is_one_of(kLetters, c) || is_one_of(kDigits, c); }

std::string_view without_leading_spaces(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

/// Parser that consumes a product from the beginning of a text.
class Factors {
 public:
  explicit Factors(std::string_view text) : text_(text), rest_(without_leading_spaces(text)) {}

  ProductText product() {
    if (takes('-'))
      product_.number = -1;
    else
      takes('+');
    do {
      rest_ = without_leading_spaces(rest_);
      if (takes('$'))
        name();
      else
        number();
      rest_ = without_leading_spaces(rest_);
    } while (takes('*'));
    product_.unit = rest_.substr(0, rest_.find_last_not_of(" \t") + 1);
    if (is_one_of(rest_, '$') || !std::isfinite(product_.number)) refuse();
    return product_;
  }

 private:
  bool takes(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void name() {
    const auto* const end = std::find_if_not(rest_.begin(), rest_.end(), is_in_name);
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    if (!is_variable_name(rest_.substr(0, length))) refuse();
    product_.names.emplace_back(rest_.substr(0, length));
    rest_.remove_prefix(length);
  }

  void number() {
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) refuse();
    const auto length = static_cast<std::size_t>(end - rest_.data());
    const std::string_view digits = rest_.substr(0, length);
    product_.number *= value;
    product_.is_whole =
        product_.is_whole && digits.find_first_not_of(kDigits, digits.starts_with('-') ? 1 : 0) ==
                                 std::string_view::npos;
    rest_.remove_prefix(length);
  }

  [[noreturn]] void refuse() const {
    throw InputError(
        "expected a product of numbers and variables with at most one unit, such as \"-2*$length\" "
        "or \"$side*3.15 in\", found \"" +
        printable(text_) + "\"");
  }

  std::string_view text_, rest_;
  ProductText product_;
};

}  // namespace

bool is_variable_name(std::string_view text) {
  return !text.empty() && !is_one_of(kDigits, text.front()) &&
         std::all_of(text.begin(), text.end(), is_in_name);
}

bool names_variables(std::string_view text) {
  const std::string_view body = without_leading_spaces(text);
  if (body.empty() || !(is_one_of("$+-.", body.front()) || is_one_of(kDigits, body.front())))
    return false;
  for (std::size_t k = body.find('$'); k != std::string_view::npos; k = body.find('$', k + 1))
    if (k + 1 < body.size() && is_one_of(kLetters, body[k + 1])) return true;
  return false;
}

ProductText parse_product(std::string_view text) { return Factors(text).product(); }

}  // namespace flexneck::pipeline
