// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/expression.h"

#include <algorithm>
#include <muParser.h>
#include <numbers>
#include <string_view>
#include <vector>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

struct Expression::Impl {
  std::vector<double> values;  ///< values of the variables, to which the parser points
  mu::Parser parser;
};

namespace {

/// Checks for input that muParser accepts with a surprising meaning: "9,81" is 81, "t = 0" sets the
/// time, and "0 < t < 1" compares a truth value with 1.
class Grammar {
 public:
  explicit Grammar(std::string_view text) : text_(text) {}

  void check() {
    for (; place_ < text_.size(); ++place_) {
      const char c = text_[place_];
      if (c == '(') open_.push_back({follows_name()});
      if (c == ')' && open_.size() > 1) open_.pop_back();
      if (c == ',' && !open_.back().holds_arguments)
        refuse(
            "a comma is allowed only between the arguments of a function; use a point for "
            "decimals");
      if (c == ',' || c == '?' || c == ':' || c == '&' || c == '|') open_.back().compares = false;
      if (c == '=' || c == '<' || c == '>' || c == '!') compare();
    }
  }

 private:
  struct Parenthesis {
    bool holds_arguments = false;
    bool compares = false;  ///< since its beginning or the last token that ends a comparison
  };

  bool follows_name() const {
    const std::size_t last = text_.substr(0, place_).find_last_not_of(" \t");
    return last != std::string_view::npos &&
           (is_letter_or_digit(text_[last]) || text_[last] == '_');
  }

  void compare() {
    const bool has_equals = text_.substr(place_ + 1).starts_with('=');
    if (text_[place_] == '=' && !has_equals)
      refuse("an assignment is not allowed; use == for a comparison");
    if (has_equals) ++place_;
    if (open_.back().compares)
      refuse("chained comparisons are not supported; write (a < t) && (t < b)");
    open_.back().compares = true;
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw InputError("\"" + printable(text_) + "\" is not a valid expression: at character " +
                     std::to_string(place_ + 1) + ": " + reason);
  }

  std::string_view text_;
  std::size_t place_ = 0;
  std::vector<Parenthesis> open_ = {{}};
};

}  // namespace

Expression::Expression(const std::string& text, const std::vector<std::string>& variables)
    : impl_(std::make_shared<Impl>()) {
  Grammar(text).check();
  impl_->values.resize(variables.size());
  try {
    impl_->parser.DefineConst("pi", std::numbers::pi);
    impl_->parser.DefineConst("gn", kStandardGravity_m_s2);
    for (std::size_t k = 0; k < variables.size(); ++k)
      impl_->parser.DefineVar(variables[k], &impl_->values[k]);
    impl_->parser.SetExpr(text);
    impl_->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw InputError("\"" + printable(text) +
                     "\" is not a valid expression: " + printable(error.GetMsg()));
  }
}

double Expression::operator()(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), impl_->values.begin());
  return impl_->parser.Eval();
}

bool Expression::has(const std::string& variable) const {
  return impl_->parser.GetUsedVar().count(variable) > 0;
}

}  // namespace flexneck::pipeline
