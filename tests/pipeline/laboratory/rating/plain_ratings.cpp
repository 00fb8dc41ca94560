// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/pipeline/laboratory/rating/plain_ratings.h"

#include <cmath>

namespace flexneck::testing {
namespace {

int size_of(const Samples& curve) { return static_cast<int>(curve.size()); }

double at(const Samples& curve, int k) { return curve[static_cast<std::size_t>(k)]; }

double largest(const Samples& curve) {
  double most = 0;
  for (const double value : curve) most = std::fmax(most, std::fabs(value));
  return most;
}

double plain_corridor(const Samples& t, const Samples& c) {
  const double inner = 0.05 * largest(t);
  const double outer = 0.5 * largest(t);
  double sum = 0;
  for (int k = 0; k < size_of(t); ++k) {
    const double distance = std::fabs(at(c, k) - at(t, k));
    if (distance < inner)
      sum += 1;
    else if (distance < outer)
      sum += std::pow((outer - distance) / (outer - inner), 2);
  }
  return sum / size_of(t);
}

/// Overlapping parts of both curves if the computed one is `shift` samples late.
void cut(const Samples& t, const Samples& c, int shift, Samples& left_t, Samples& left_c) {
  left_t.clear();
  left_c.clear();
  for (int k = 0; k < size_of(t); ++k) {
    if (k + shift < 0 || k + shift >= size_of(c)) continue;
    left_t.push_back(at(t, k));
    left_c.push_back(at(c, k + shift));
  }
}

double plain_correlation(const Samples& t, const Samples& c, bool about_mean) {
  double mean_t = 0;
  double mean_c = 0;
  for (int k = 0; k < size_of(t) && about_mean; ++k) {
    mean_t += at(t, k) / size_of(t);
    mean_c += at(c, k) / size_of(c);
  }
  double tt = 0;
  double cc = 0;
  double tc = 0;
  for (int k = 0; k < size_of(t); ++k) {
    tt += (at(t, k) - mean_t) * (at(t, k) - mean_t);
    cc += (at(c, k) - mean_c) * (at(c, k) - mean_c);
    tc += (at(t, k) - mean_t) * (at(c, k) - mean_c);
  }
  return tc / std::sqrt(tt * cc);
}

struct PlainShift {
  int shift;
  double correlation;
};

PlainShift plain_shift(const Samples& t, const Samples& c, bool about_mean) {
  PlainShift best{0, plain_correlation(t, c, about_mean)};
  Samples left_t;
  Samples left_c;
  for (int m = 1; 5 * m <= size_of(t); ++m)
    for (const int shift : {m, -m}) {
      cut(t, c, shift, left_t, left_c);
      const double found = plain_correlation(left_t, left_c, about_mean);
      if (found > best.correlation + 1e-12) best = {shift, found};
    }
  return best;
}

/// Sum of |c - t| over that of |t| for the warped pair.
double plain_warped_error(const Samples& t, const Samples& c) {
  const int n = size_of(t);
  const int band = (n + 9) / 10;  // n / 10, rounded up
  std::vector<Samples> cost(c.size(), Samples(t.size(), HUGE_VAL));
  const auto of = [&](int i, int j) {
    return i < 0 || j < 0 ? HUGE_VAL : at(cost[static_cast<std::size_t>(i)], j);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (std::abs(i - j) >= band) continue;
      const double before =
          i + j == 0 ? 0 : std::fmin(of(i - 1, j), std::fmin(of(i, j - 1), of(i - 1, j - 1)));
      cost[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          before + (at(c, i) - at(t, j)) * (at(c, i) - at(t, j));
    }
  double error = 0;
  double whole = 0;
  for (int i = n - 1, j = n - 1; i >= 0;) {
    error += std::fabs(at(c, i) - at(t, j));
    whole += std::fabs(at(t, j));
    const double least = std::fmin(of(i - 1, j), std::fmin(of(i, j - 1), of(i - 1, j - 1)));
    if (i + j == 0) break;
    if (of(i - 1, j) == least) {
      --i;
    } else if (of(i, j - 1) == least) {
      --j;
    } else {
      --i;
      --j;
    }
  }
  return error / whole;
}

Samples plain_slopes(const Samples& curve) {
  const int n = size_of(curve);
  Samples slopes;
  for (int k = 0; k < n; ++k) {
    const int before = k == 0 ? 0 : k - 1;
    const int after = k == n - 1 ? n - 1 : k + 1;
    slopes.push_back((at(curve, after) - at(curve, before)) / (1e-4 * (after - before)));
  }
  Samples smooth;
  for (int k = 0; k < n; ++k) {
    int half = 4;
    while (k - half < 0 || k + half >= n) --half;
    double sum = 0;
    for (int other = k - half; other <= k + half; ++other) sum += at(slopes, other);
    smooth.push_back(sum / (2 * half + 1));
  }
  return smooth;
}

double plain_slope_error(const Samples& t, const Samples& c) {
  const Samples slope_t = plain_slopes(t);
  const Samples slope_c = plain_slopes(c);
  double error = 0;
  double whole = 0;
  for (int k = 0; k < size_of(t); ++k) {
    error += std::fabs(at(slope_c, k) - at(slope_t, k));
    whole += std::fabs(at(slope_t, k));
  }
  return error / whole;
}

}  // namespace

PlainIso18571 plain_iso18571(const Samples& reference, const Samples& computed) {
  PlainIso18571 rating{};
  rating.corridor = plain_corridor(reference, computed);
  rating.shift = plain_shift(reference, computed, true).shift;
  rating.phase = std::fmax(0, 1 - std::abs(rating.shift) / (0.2 * size_of(reference)));
  Samples t;
  Samples c;
  cut(reference, computed, rating.shift, t, c);
  rating.magnitude = std::fmax(0, 1 - plain_warped_error(t, c) / 0.5);
  rating.slope = std::fmax(0, 1 - plain_slope_error(t, c) / 2);
  rating.overall = (2 * rating.corridor + rating.phase + rating.magnitude + rating.slope) / 5;
  return rating;
}

PlainCora plain_cora(const Samples& reference, const Samples& computed) {
  PlainCora rating{};
  rating.corridor = plain_corridor(reference, computed);
  const PlainShift best = plain_shift(reference, computed, false);
  rating.shift = best.shift;
  rating.progression = std::pow((best.correlation + 1) / 2, 10);
  Samples t;
  Samples c;
  cut(reference, computed, best.shift, t, c);
  double squares_t = 0;
  double squares_c = 0;
  for (const double value : t) squares_t += value * value;
  for (const double value : c) squares_c += value * value;
  rating.size = std::fmin(squares_t, squares_c) / std::fmax(squares_t, squares_c);
  const double share = std::abs(best.shift) / (size_of(reference) - 1.0);
  rating.phase = share < 0.01 ? 1 : share > 0.12 ? 0 : (0.12 - share) / 0.11;
  rating.overall =
      rating.corridor / 2 + (rating.progression / 2 + rating.size / 4 + rating.phase / 4) / 2;
  return rating;
}

}  // namespace flexneck::testing
