// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

namespace flexneck::pipeline {

/// A function of time written as a text, such as "0.05 * sin(2 * pi * 3 * t)": t in s, the
/// constants pi and gn, the functions of muParser and its operators but assignment and sequence.
class Expression {
 public:
  /// @throws InputError for what cannot be read: where, and what is wrong.
  explicit Expression(const std::string& text);
  double operator()(double time_s) const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;  // std::function copies what it holds
};

}  // namespace flexneck::pipeline
