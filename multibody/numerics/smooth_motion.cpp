// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/smooth_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

using Piece = SmoothMotion::Piece;
using Series = SmoothMotion::Series;
constexpr std::size_t kTerms = SmoothMotion::kTerms;

/// Of the function's largest value: what the last coefficients of a piece may reach.
constexpr double kResolution = 1e-13;
/// A piece of this length that is not resolved holds a kink or a jump.
constexpr double kShortest_s = 1e-8;
constexpr std::size_t kMaxBreakpoints = 200;

[[noreturn]] void refuse(double time_s, const std::string& problem) {
  std::ostringstream text;
  text << "the motion " << problem << " at " << time_s << " s";
  throw InputError(text.str());
}

struct Span {
  double begin_s, end_s;
  Series series;
};

/// Interpolates at the Chebyshev nodes, which lie inside of the interval.
Span interpolate(const SmoothMotion::Function& f, double begin_s, double end_s) {
  std::array<double, kTerms> values{};
  const double step = std::numbers::pi / static_cast<double>(kTerms);
  for (std::size_t j = 0; j < kTerms; ++j) {
    const double x = std::cos(step * (static_cast<double>(j) + 0.5));
    const double time_s = 0.5 * (begin_s + end_s) + 0.5 * (end_s - begin_s) * x;
    values[j] = f(time_s);
    if (!std::isfinite(values[j])) refuse(time_s, "is not a finite number");
  }
  Span span{begin_s, end_s, {}};
  for (std::size_t k = 0; k < kTerms; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < kTerms; ++j)
      sum += values[j] * std::cos(step * static_cast<double>(k) * (static_cast<double>(j) + 0.5));
    span.series[k] = (k == 0 ? 1.0 : 2.0) * sum / static_cast<double>(kTerms);
  }
  return span;
}

bool is_resolved(const Span& span, double scale) {
  return std::all_of(span.series.begin() + kTerms - 3, span.series.begin() + kTerms,
                     [&](double term) { return std::abs(term) <= kResolution * scale; });
}

/// Where the function jumps inside a short interval, to rounding; anywhere inside for a kink.
double locate(const SmoothMotion::Function& f, double begin_s, double end_s) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (begin_s + end_s);
    if (!(middle > begin_s && middle < end_s)) break;
    if (std::abs(f(middle) - f(begin_s)) > std::abs(f(end_s) - f(middle)))
      end_s = middle;
    else
      begin_s = middle;
  }
  return end_s;
}

Series derivative(const Series& of, double length_s) {
  Series result{};
  for (std::size_t k = of.size() - 1; k > 0; --k) {
    const double above = k + 1 < of.size() ? result[k + 1] : 0;
    result[k - 1] = above + 2 * static_cast<double>(k) * of[k];
  }
  result[0] /= 2;
  for (double& term : result) term *= 2 / length_s;
  return result;
}

/// The integral from the interval's beginning, where it is `start`.
Series integral(const Series& of, double length_s, double start) {
  Series result{};
  double at_beginning = 0;
  for (std::size_t k = 1; k < of.size(); ++k) {
    const double below = k == 1 ? 2 * of[0] : of[k - 1];
    const double above = k + 1 < of.size() ? of[k + 1] : 0;
    result[k] = (below - above) / (2 * static_cast<double>(k)) * length_s / 2;
    at_beginning += k % 2 == 0 ? result[k] : -result[k];
  }
  result[0] = start - at_beginning;
  return result;
}

/// Clenshaw's sum at x in [-1, 1].
double sum_of(const Series& series, double x) {
  double one = 0;
  double two = 0;
  for (std::size_t k = series.size() - 1; k > 0; --k) {
    const double next = 2 * x * one - two + series[k];
    two = one;
    one = next;
  }
  return x * one - two + series[0];
}

/// Pieces of one function: cut in halves until resolved, and wherever it is not smooth.
class Fit {
 public:
  Fit(const SmoothMotion::Function& f, double end_s) : f_(f), end_s_(end_s) {
    const auto sample = [&](double time_s) {
      if (!std::isfinite(f(time_s))) refuse(time_s, "is not a finite number");
      scale_ = std::max(scale_, std::abs(f(time_s)));
    };
    constexpr int kSamples = 257;
    for (int k = 0; k < kSamples; ++k) sample(end_s * (k + 0.5) / kSamples);
    // The ends are no Chebyshev nodes, but a run starts and stops there.
    sample(0);
    sample(end_s);
    // Again from the start whenever a cut is found: its neighbours then end exactly there.
    while (!cover_all()) {
      if (cuts_.size() > kMaxBreakpoints) refuse(cuts_.back(), "is not piecewise smooth, e.g.");
      std::sort(cuts_.begin(), cuts_.end());
    }
    find_hidden_cuts();
  }

  const std::vector<Span>& spans() const { return spans_; }
  const std::vector<double>& cuts() const { return cuts_; }

 private:
  bool cover_all() {
    spans_.clear();
    double begin = 0;
    for (const double cut : std::vector<double>(cuts_)) {
      if (!cover(begin, cut)) return false;
      begin = cut;
    }
    return cover(begin, end_s_);
  }

  bool cover(double begin_s, double end_s) {
    const Span span = interpolate(f_, begin_s, end_s);
    const bool is_short = end_s - begin_s < kShortest_s;
    const auto is_near = [&](double cut) {
      return cut > begin_s - 2 * kShortest_s && cut < end_s + 2 * kShortest_s;
    };
    if (is_resolved(span, scale_) ||
        (is_short && std::any_of(cuts_.begin(), cuts_.end(), is_near))) {
      spans_.push_back(span);
      return true;
    }
    if (is_short) {
      cuts_.push_back(locate(f_, begin_s, end_s));
      return false;
    }
    const double middle = 0.5 * (begin_s + end_s);
    return cover(begin_s, middle) && cover(middle, end_s);
  }

  /// Where halving has met a kink or a jump by chance, pieces on both sides are resolved.
  void find_hidden_cuts() {
    double steepest = 0;
    std::vector<Series> slopes;
    for (const Span& span : spans_) {
      slopes.push_back(derivative(span.series, span.end_s - span.begin_s));
      for (const double x : {-1.0, 0.0, 1.0})
        steepest = std::max(steepest, std::abs(sum_of(slopes.back(), x)));
    }
    for (std::size_t k = 1; k < spans_.size(); ++k) {
      const double at = spans_[k].begin_s;
      const double shortest = std::min(spans_[k].end_s - at, at - spans_[k - 1].begin_s);
      const double jump = sum_of(spans_[k].series, -1) - sum_of(spans_[k - 1].series, 1);
      const double kink = sum_of(slopes[k], -1) - sum_of(slopes[k - 1], 1);
      // Rounding of the series grows in their slopes as the pieces shorten.
      if (std::abs(jump) > 1e-9 * scale_ ||
          std::abs(kink) > 1e-6 * steepest + 1e3 * kResolution * scale_ / shortest)
        cuts_.push_back(at);
    }
    std::sort(cuts_.begin(), cuts_.end());
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
  }

  const SmoothMotion::Function& f_;
  double end_s_;
  double scale_ = 0;
  std::vector<Span> spans_;
  std::vector<double> cuts_;
};

void check_rows(const std::vector<double>& times_s, const std::vector<double>& values) {
  if (times_s.size() != values.size() || times_s.size() < 4)
    throw InputError("a table of displacements needs four rows or more, as many times as values");
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (!std::isfinite(values[k])) refuse(times_s[k], "is not a finite number");
    if (k > 0 && !(times_s[k] > times_s[k - 1]))
      refuse(times_s[k], "has times that do not increase,");
  }
}

/// Slopes of the spline at the rows: a tridiagonal system, whose first and last rows say that the
/// third derivative does not jump at the row next to the end.
std::vector<double> spline_slopes(const std::vector<double>& t, const std::vector<double>& y) {
  check_rows(t, y);
  const std::size_t n = t.size();
  const auto h = [&](std::size_t k) { return t[k + 1] - t[k]; };
  const auto rise = [&](std::size_t k) { return (y[k + 1] - y[k]) / h(k); };
  /// The end's row from the interval at the end and the one before it.
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

SmoothMotion SmoothMotion::of_displacement(const Function& displacement_m, double end_s) {
  const Fit fit(displacement_m, end_s);
  if (!fit.cuts().empty()) refuse(fit.cuts().front(), "has a jump or a kink, but must be smooth,");
  SmoothMotion motion;
  for (const Span& span : fit.spans()) {
    const double length_s = span.end_s - span.begin_s;
    Piece piece{span.begin_s, span.end_s, span.series, derivative(span.series, length_s), {}};
    piece.acceleration = derivative(piece.velocity, length_s);
    motion.pieces_.push_back(piece);
  }
  return motion;
}

SmoothMotion SmoothMotion::of_acceleration(const Function& acceleration_m_s2, double end_s) {
  const Fit fit(acceleration_m_s2, end_s);
  SmoothMotion motion;
  motion.breakpoints_s_ = fit.cuts();
  double velocity = 0;
  double displacement = 0;
  for (const Span& span : fit.spans()) {
    const double length_s = span.end_s - span.begin_s;
    Piece piece{span.begin_s, span.end_s, {}, {}, span.series};
    piece.velocity = integral(piece.acceleration, length_s, velocity);
    piece.displacement = integral(piece.velocity, length_s, displacement);
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

double SmoothMotion::displacement_m(double time_s) const {
  return value(time_s, &Piece::displacement);
}
double SmoothMotion::velocity_m_s(double time_s) const { return value(time_s, &Piece::velocity); }
double SmoothMotion::acceleration_m_s2(double time_s) const {
  return value(time_s, &Piece::acceleration);
}

}  // namespace flexneck::multibody
