// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include <Eigen/Core>

namespace flexneck::testing {

/// d f / d t at t = 0 by the central difference of order 6. f gives anything with + and scaling.
template <typename Function>
auto first_derivative(Function&& f, double h) {
  using Value = decltype(f(0.0));
  const Value one = f(h) - f(-h);
  const Value two = f(2 * h) - f(-2 * h);
  const Value three = f(3 * h) - f(-3 * h);
  return Value((45 * one - 9 * two + three) / (60 * h));
}

/// d^2 f / d t^2 at t = 0 by the central difference of order 6.
template <typename Function>
auto second_derivative(Function&& f, double h) {
  using Value = decltype(f(0.0));
  const Value zero = f(0.0);
  const Value one = f(h) + f(-h);
  const Value two = f(2 * h) + f(-2 * h);
  const Value three = f(3 * h) + f(-3 * h);
  return Value((-490 * zero + 270 * one - 27 * two + 2 * three) / (180 * h * h));
}

}  // namespace flexneck::testing
