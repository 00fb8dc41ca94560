// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/chebyshev_series.h"

#include <cmath>
#include <numbers>

namespace flexneck::multibody {
namespace {

using Table = std::array<std::array<double, kChebyshevTerms>, kChebyshevTerms>;

/// Table of T_k at node j: cos(k pi (j + 1/2) / n).
const Table& cosines() {
  static const Table table = [] {
    Table made{};
    const double step = std::numbers::pi / static_cast<double>(kChebyshevTerms);
    for (std::size_t k = 0; k < kChebyshevTerms; ++k)
      for (std::size_t j = 0; j < kChebyshevTerms; ++j)
        made[k][j] = std::cos(step * static_cast<double>(k) * (static_cast<double>(j) + 0.5));
    return made;
  }();
  return table;
}

}  // namespace

ChebyshevSeries interpolated(const std::function<double(double)>& f, double begin, double end) {
  const Table& T = cosines();
  std::array<double, kChebyshevTerms> values{};
  for (std::size_t j = 0; j < kChebyshevTerms; ++j)
    values[j] = f(0.5 * (begin + end) + 0.5 * (end - begin) * T[1][j]);
  ChebyshevSeries series{};
  for (std::size_t k = 0; k < kChebyshevTerms; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < kChebyshevTerms; ++j) sum += values[j] * T[k][j];
    series[k] = (k == 0 ? 1.0 : 2.0) * sum / static_cast<double>(kChebyshevTerms);
  }
  return series;
}

ChebyshevSeries derivative(const ChebyshevSeries& of, double length) {
  ChebyshevSeries result{};
  for (std::size_t k = of.size() - 1; k > 0; --k) {
    const double above = k + 1 < of.size() ? result[k + 1] : 0;
    result[k - 1] = above + 2 * static_cast<double>(k) * of[k];
  }
  result[0] /= 2;
  for (double& term : result) term *= 2 / length;
  return result;
}

ChebyshevSeries integral(const ChebyshevSeries& of, double length, double start) {
  ChebyshevSeries result{};
  double at_beginning = 0;
  for (std::size_t k = 1; k < of.size(); ++k) {
    const double below = k == 1 ? 2 * of[0] : of[k - 1];
    const double above = k + 1 < of.size() ? of[k + 1] : 0;
    result[k] = (below - above) / (2 * static_cast<double>(k)) * length / 2;
    at_beginning += k % 2 == 0 ? result[k] : -result[k];
  }
  result[0] = start - at_beginning;
  return result;
}

/// Sum by Clenshaw's recurrence.
double sum_of(const ChebyshevSeries& series, double x) {
  double one = 0;
  double two = 0;
  for (std::size_t k = series.size() - 1; k > 0; --k) {
    const double next = 2 * x * one - two + series[k];
    two = one;
    one = next;
  }
  return x * one - two + series[0];
}

}  // namespace flexneck::multibody
