// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/smooth_motion.h"

#include <algorithm>
#include <cmath>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

using Piece = SmoothMotion::Piece;
using Series = SmoothMotion::Series;

void check_rows(const std::vector<double>& times_s, const std::vector<double>& values) {
  if (times_s.size() != values.size() || times_s.size() < 4)
    throw InputError(
        "a table of displacements needs at least four rows with a time and a value each");
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (!std::isfinite(values[k])) refuse_motion(times_s[k], "is not a finite number");
    if (k > 0 && !(times_s[k] > times_s[k - 1]))
      refuse_motion(times_s[k], "has times that do not increase,");
  }
}

/// Slopes of the spline at the rows, from a tridiagonal system; its first and last equations
/// require that the third derivative does not jump at the row next to the end.
std::vector<double> spline_slopes(const std::vector<double>& t, const std::vector<double>& y) {
  check_rows(t, y);
  const std::size_t n = t.size();
  const auto h = [&](std::size_t k) { return t[k + 1] - t[k]; };
  const auto rise = [&](std::size_t k) { return (y[k + 1] - y[k]) / h(k); };
  /// Right-hand side of an end's equation, from the interval at the end and the one before it.
  const auto end = [&](std::size_t outer, std::size_t inner) {
    const double sum = h(outer) + h(inner);
    return ((h(outer) + 2 * sum) * h(inner) * rise(outer) + h(outer) * h(outer) * rise(inner)) /
           sum;
  };
  std::vector<double> diagonal(n);
  std::vector<double> above(n);
  std::vector<double> slopes(n);
  diagonal[0] = h(1);
  above[0] = h(0) + h(1);
  slopes[0] = end(0, 1);
  for (std::size_t k = 1; k < n; ++k) {
    const bool is_last = k + 1 == n;
    const double below = is_last ? h(n - 2) + h(n - 3) : h(k);
    const double factor = below / diagonal[k - 1];
    diagonal[k] = (is_last ? h(n - 3) : 2 * (h(k - 1) + h(k))) - factor * above[k - 1];
    above[k] = is_last ? 0 : h(k - 1);
    slopes[k] = (is_last ? end(n - 2, n - 3) : 3 * (h(k) * rise(k - 1) + h(k - 1) * rise(k))) -
                factor * slopes[k - 1];
  }
  for (std::size_t k = n; k-- > 0;) {
    if (k + 1 < n) slopes[k] -= above[k] * slopes[k + 1];
    slopes[k] /= diagonal[k];
  }
  return slopes;
}

}  // namespace

SmoothMotion SmoothMotion::of_displacement(const Function& displacement_m, double end_s,
                                           const Sampling& sampling) {
  const PiecewiseFit fit(displacement_m, end_s, sampling);
  SmoothMotion motion;
  motion.breakpoints_s_ = fit.breaks_s();
  for (std::size_t k = 0; k < fit.pieces().size(); ++k) {
    const PiecewiseFit::Piece& fitted = fit.pieces()[k];
    if (k + 1 < fit.pieces().size() && (fit.jumps(k, 0) || fit.jumps(k, 1)))
      refuse_motion(fitted.end_s, "has a jump or a kink, but must be smooth,");
    Piece piece{fitted.begin_s, fitted.end_s, fitted.series, {}, {}};
    piece.velocity = derivative(piece.displacement, fitted.length_s());
    piece.acceleration = derivative(piece.velocity, fitted.length_s());
    // Over so short a piece the value at the end of the piece before is kept.
    if (k > 0 && fit.loses(k, 1)) piece.velocity = {sum_of(motion.pieces_[k - 1].velocity, 1)};
    if (k > 0 && fit.loses(k, 2))
      piece.acceleration = {sum_of(motion.pieces_[k - 1].acceleration, 1)};
    motion.pieces_.push_back(piece);
  }
  return motion;
}

SmoothMotion SmoothMotion::of_acceleration(const Function& acceleration_m_s2, double end_s,
                                           const Sampling& sampling) {
  const PiecewiseFit fit(acceleration_m_s2, end_s, sampling);
  SmoothMotion motion;
  motion.breakpoints_s_ = fit.breaks_s();
  double velocity = 0;
  double displacement = 0;
  for (const PiecewiseFit::Piece& fitted : fit.pieces()) {
    Piece piece{fitted.begin_s, fitted.end_s, {}, {}, fitted.series};
    piece.velocity = integral(piece.acceleration, fitted.length_s(), velocity);
    piece.displacement = integral(piece.velocity, fitted.length_s(), displacement);
    velocity = sum_of(piece.velocity, 1);
    displacement = sum_of(piece.displacement, 1);
    motion.pieces_.push_back(piece);
  }
  return motion;
}

SmoothMotion SmoothMotion::of_displacement_table(const std::vector<double>& times_s,
                                                 const std::vector<double>& displacement_m) {
  const std::vector<double> slopes = spline_slopes(times_s, displacement_m);
  SmoothMotion motion;
  for (std::size_t k = 0; k + 1 < times_s.size(); ++k) {
    const double length_s = times_s[k + 1] - times_s[k];
    // Hermite's cubic in x from -1 to 1, then in Chebyshev polynomials.
    const double half_sum = (displacement_m[k] + displacement_m[k + 1]) / 2;
    const double half_rise = (displacement_m[k + 1] - displacement_m[k]) / 2;
    const double slope_sum = (slopes[k] + slopes[k + 1]) * length_s / 8;
    const double slope_rise = (slopes[k + 1] - slopes[k]) * length_s / 8;
    const double cubic = slope_sum - half_rise / 2;
    Piece piece{times_s[k], times_s[k + 1], {}, {}, {}};
    piece.displacement = {half_sum - slope_rise / 2, half_rise - cubic / 4, slope_rise / 2,
                          cubic / 4};
    piece.velocity = derivative(piece.displacement, length_s);
    piece.acceleration = derivative(piece.velocity, length_s);
    motion.pieces_.push_back(piece);
  }
  motion.breakpoints_s_.assign(times_s.begin() + 2, times_s.end() - 2);
  return motion;
}

const Piece& SmoothMotion::piece_at(double time_s) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time_s,
                                      [](double t, const Piece& p) { return t < p.begin_s; });
  return *(after - 1);
}

double SmoothMotion::value(double time_s, Series Piece::*series) const {
  if (pieces_.empty()) return 0;
  const Piece& piece = piece_at(time_s);
  const double x = (2 * time_s - piece.begin_s - piece.end_s) / (piece.end_s - piece.begin_s);
  return sum_of(piece.*series, x);
}

void SmoothMotion::add_piece_ends(double begin_s, double end_s, int parts, double max_step_s,
                                  std::vector<double>& times_s) const {
  if (pieces_.empty()) return;
  const Piece* const last = &pieces_.back() + 1;
  for (const Piece* piece = &piece_at(begin_s); piece != last && piece->begin_s < end_s; ++piece) {
    const double length_s = (piece->end_s - piece->begin_s) / parts;
    if (!(length_s < max_step_s)) continue;
    for (int k = 0; k < parts; ++k) times_s.push_back(piece->begin_s + k * length_s);
    times_s.push_back(piece->end_s);
  }
}

double SmoothMotion::displacement_m(double time_s) const {
  return value(time_s, &Piece::displacement);
}
double SmoothMotion::velocity_m_s(double time_s) const { return value(time_s, &Piece::velocity); }
double SmoothMotion::acceleration_m_s2(double time_s) const {
  return value(time_s, &Piece::acceleration);
}

}  // namespace flexneck::multibody
