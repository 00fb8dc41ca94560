// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A function of named variables written as a text, such as "0.05 * sin(2 * pi * 3 * t)" of the
/// time t in s: with the constants pi and gn, muParser's functions and its operators except
/// assignment and sequence. Copies share the parser, which one thread at a time may use.
class Expression {
 public:
  /// @throws InputError with place and reason for an invalid text; for a variable whose name is
  /// invalid or that of a constant.
  explicit Expression(const std::string& text, const std::vector<std::string>& variables = {"t"});
  /// @param values  values of the variables, in their order
  double operator()(std::span<const double> values) const;
  double operator()(double time_s) const { return (*this)(std::span(&time_s, 1)); }
  bool has(const std::string& variable) const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;  // shared, since std::function copies its content
};

}  // namespace flexneck::pipeline
