// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace flexneck::multibody {

/// Coefficients of T_0, T_1, … over an interval, with space for two integrations.
inline constexpr std::size_t kChebyshevTerms = 18;
using ChebyshevSeries = std::array<double, kChebyshevTerms + 2>;

/// The interpolant of a function.
/// @param f  called at the Chebyshev nodes, which lie inside the interval
ChebyshevSeries interpolated(const std::function<double(double)>& f, double begin, double end);
/// Derivative of a series over an interval of this length.
ChebyshevSeries derivative(const ChebyshevSeries& of, double length);
/// Integral of a series from the interval's beginning, where it is `start`.
ChebyshevSeries integral(const ChebyshevSeries& of, double length, double start);
/// Value of a series.
/// @param x  in [-1, 1]
double sum_of(const ChebyshevSeries& series, double x);

}  // namespace flexneck::multibody
