// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexneck::pipeline {

/// A product of numbers and variables with an optional unit, such as "-$length", "2*$mass" or
/// "$side*3.15 in"; a plain "3.15 in" also is one.
struct ProductText {
  double number = 1;               ///< product of the sign and of the numbers
  bool is_whole = true;            ///< none of the numbers has a point or an exponent
  std::vector<std::string> names;  ///< names of the variables, without '$'
  std::string unit;                ///< the text after the last factor; may be empty
};

/// True for letters, digits and '_' that do not begin with a digit.
bool is_variable_name(std::string_view text);

/// True for a text that begins as a product and names a variable; other texts are not products.
bool names_variables(std::string_view text);

/// @throws InputError without the key, which the caller prefixes
ProductText parse_product(std::string_view text);

}  // namespace flexneck::pipeline
