// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/relaxation_law.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <fmt/core.h>

#include "pipeline/language/model/nonnegative_least_squares.h"
#include "pipeline/language/model/relaxation.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

std::complex<double> modulus_ratio(const Relaxation& branches, double frequency_Hz) {
  std::complex<double> ratio = 1;
  for (std::size_t k = 0; k < branches.times_s.size(); ++k)
    ratio -=
        branches.shares[k] / std::complex<double>(1, 2 * pi * frequency_Hz * branches.times_s[k]);
  return ratio;
}

double relaxed_ratio(const Relaxation& branches, double time_s) {
  double ratio = 1;
  for (std::size_t k = 0; k < branches.times_s.size(); ++k)
    ratio += branches.shares[k] * std::expm1(-time_s / branches.times_s[k]);
  return ratio;
}

std::complex<double> fractional_ratio(double share, double time_s, double order,
                                      double frequency_Hz) {
  const std::complex<double> i(0, 1);
  return 1. - share / (1. + std::pow(i * (2 * pi * frequency_Hz * time_s), order));
}

namespace {

/// Relaxation times of branches, spaced evenly by their logarithm; a single one is in the middle.
std::vector<double> spread(double first_s, double last_s, int count) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k) {
    const double place = count == 1 ? 0.5 : static_cast<double>(k) / (count - 1);
    times.push_back(first_s * std::pow(last_s / first_s, place));
  }
  return times;
}

/// Values of a law at a number of points, over the instantaneous modulus: the relaxed part is the
/// sum over branches of share times basis.
struct Points {
  MatrixXd basis;  ///< (rows, branches)
  VectorXd lost;   ///< (rows), relaxed part
  VectorXd size;   ///< (rows), magnitude of the modulus there, for errors
  /// Number of rows per modulus: one, or two for storage and loss, the rows of loss following.
  Index parts = 1;
};

Points dynamic_points(const std::vector<double>& frequencies_Hz,
                      const std::vector<std::complex<double>>& ratios,
                      const std::vector<double>& times_s) {
  const auto count = static_cast<Index>(frequencies_Hz.size());
  Points points{MatrixXd(2 * count, static_cast<Index>(times_s.size())), VectorXd(2 * count),
                VectorXd(2 * count), 2};
  for (Index p = 0; p < count; ++p) {
    const auto at = static_cast<std::size_t>(p);
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      const std::complex<double> lost =
          1. / std::complex<double>(1, 2 * pi * frequencies_Hz[at] * times_s[k]);
      points.basis(p, static_cast<Index>(k)) = lost.real();
      points.basis(count + p, static_cast<Index>(k)) = lost.imag();
    }
    points.lost[p] = 1 - ratios[at].real();
    points.lost[count + p] = -ratios[at].imag();
    points.size[p] = points.size[count + p] = std::abs(ratios[at]);
  }
  return points;
}

Points relaxation_points(const std::vector<double>& law_times_s, const std::vector<double>& ratios,
                         const std::vector<double>& times_s) {
  const auto count = static_cast<Index>(law_times_s.size());
  Points points{MatrixXd(count, static_cast<Index>(times_s.size())), VectorXd(count),
                VectorXd(count)};
  for (Index p = 0; p < count; ++p) {
    const auto at = static_cast<std::size_t>(p);
    for (std::size_t k = 0; k < times_s.size(); ++k)
      points.basis(p, static_cast<Index>(k)) = -std::expm1(-law_times_s[at] / times_s[k]);
    points.lost[p] = 1 - ratios[at];
    points.size[p] = ratios[at];
  }
  return points;
}

/// Nonnegative shares whose sum is at most one.
VectorXd fitted_shares(const Points& points) {
  const MatrixXd A = points.size.cwiseInverse().asDiagonal() * points.basis;
  const VectorXd b = points.lost.cwiseQuotient(points.size);
  VectorXd shares = nonnegative_least_squares(A, b);
  if (shares.sum() <= 1) return shares;
  // The sum is then one, by a row with a dominant weight.
  const double weight = 1e6 * A.norm();
  MatrixXd with_sum(A.rows() + 1, A.cols());
  with_sum << A, Eigen::RowVectorXd::Constant(A.cols(), weight);
  VectorXd right(b.size() + 1);
  right << b, weight;
  shares = nonnegative_least_squares(with_sum, right);
  return shares / shares.sum();
}

/// Largest error of the moduli, relative to the law's.
double largest_error(const Points& points, const VectorXd& shares) {
  const VectorXd misses = (points.basis * shares - points.lost).cwiseQuotient(points.size);
  return misses.reshaped(misses.size() / points.parts, points.parts).rowwise().norm().maxCoeff();
}

Relaxation fitted(const StudyTable& law, const Points& points, const std::vector<double>& times_s,
                  const std::string& what) {
  const VectorXd shares = fitted_shares(points);
  Relaxation branches;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (!(shares[static_cast<Index>(k)] > 0)) continue;
    branches.times_s.push_back(times_s[k]);
    branches.shares.push_back(shares[static_cast<Index>(k)]);
  }
  const double error = largest_error(points, shares);
  if (!(error <= law.number("largest_error")))
    law.refuse("branches",
               fmt::format("{} branches fitted to {} have an error of {:.2g} of the modulus, "
                           "expected at most largest_error; use more branches or a narrower range",
                           times_s.size(), what, error));
  if (branches.times_s.empty()) law.refuse("branches", "there is no relaxation in " + what);
  branches.fit = fmt::format("{} fitted to {}, largest error {:.2g} of the modulus",
                             branches.times_s.size(), what, error);
  return branches;
}

/// Moduli of a list, with the length of another, over the instantaneous modulus.
std::vector<double> ratios_of(const StudyTable& law, const std::string& key, std::size_t count) {
  std::vector<double> moduli = law.quantities(key, count);
  const double modulus = law.quantity("modulus");
  for (double& each : moduli) {
    if (!(each >= 0 && each <= modulus))
      law.refuse(key, fmt::format("expected moduli from 0 to 'modulus', {:g} Pa, so that the "
                                  "shares do not exceed one, found {:g} Pa",
                                  modulus, each));
    each /= modulus;
  }
  return moduli;
}

/// Values that are positive and increasing, at least two.
std::vector<double> places(const StudyTable& law, const std::string& key) {
  std::vector<double> all = law.quantities(key);
  if (all.size() < 2) law.refuse(key, "expected at least two values");
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!(all[k] > (k == 0 ? 0 : all[k - 1])))
      law.refuse(
          key, "expected positive values that increase strictly, which is not the case for value " +
                   std::to_string(k + 1));
  return all;
}

void refuse_others(const StudyTable& law, const std::vector<std::string>& keys,
                   const std::string& by) {
  law.refuse_given(keys, "expected a single law, either fractional or given by a table; '" + by +
                             "' belongs to another one");
}

std::string band_text(double low_Hz, double high_Hz) {
  return fmt::format("{:g} to {:g} Hz", low_Hz, high_Hz);
}

Relaxation of_fractional(const StudyTable& law, int count) {
  refuse_others(law, {"frequencies", "storage", "loss", "times", "moduli", "modulus"}, "order");
  const double order = law.number("order");
  const double share = law.number("share");
  const double time_s = law.quantity("time");
  const double low_Hz = law.quantity("from");
  const double high_Hz = law.quantity("to");
  if (!(high_Hz > low_Hz)) law.refuse("to", "expected a frequency above 'from'");
  constexpr double kPerDecade = 12;
  const auto points =
      static_cast<std::size_t>(std::ceil(kPerDecade * std::log10(high_Hz / low_Hz))) + 1;
  std::vector<double> frequencies_Hz;
  std::vector<std::complex<double>> ratios;
  for (std::size_t k = 0; k < points; ++k) {
    const double place = static_cast<double>(k) / static_cast<double>(points - 1);
    frequencies_Hz.push_back(low_Hz * std::pow(high_Hz / low_Hz, place));
    ratios.push_back(fractional_ratio(share, time_s, order, frequencies_Hz.back()));
  }
  // A law of order one is a branch, whose time need not lie in the band.
  const std::vector<double> times_s =
      order == 1 ? std::vector{time_s}
                 : spread(1 / (2 * pi * high_Hz), 1 / (2 * pi * low_Hz), count);
  return fitted(
      law, dynamic_points(frequencies_Hz, ratios, times_s), times_s,
      fmt::format("a fractional law of order {:g} over {}", order, band_text(low_Hz, high_Hz)));
}

Relaxation of_dynamic(const StudyTable& law, int count) {
  refuse_others(law, {"share", "time", "order", "from", "to", "times", "moduli"}, "frequencies");
  const std::vector<double> frequencies_Hz = places(law, "frequencies");
  const std::vector<double> storage = ratios_of(law, "storage", frequencies_Hz.size());
  const std::vector<double> loss = ratios_of(law, "loss", frequencies_Hz.size());
  std::vector<std::complex<double>> ratios;
  for (std::size_t k = 0; k < storage.size(); ++k) {
    ratios.emplace_back(storage[k], loss[k]);
    if (std::abs(ratios.back()) == 0)
      law.refuse("storage", "expected a modulus above zero at each frequency");
  }
  const std::vector<double> times_s =
      spread(1 / (2 * pi * frequencies_Hz.back()), 1 / (2 * pi * frequencies_Hz.front()), count);
  return fitted(law, dynamic_points(frequencies_Hz, ratios, times_s), times_s,
                "a table of the dynamic modulus over " +
                    band_text(frequencies_Hz.front(), frequencies_Hz.back()));
}

Relaxation of_relaxation(const StudyTable& law, int count) {
  refuse_others(law, {"share", "time", "order", "from", "to"}, "times");
  const std::vector<double> law_times_s = places(law, "times");
  const std::vector<double> ratios = ratios_of(law, "moduli", law_times_s.size());
  for (const double ratio : ratios)
    if (ratio == 0) law.refuse("moduli", "expected moduli above zero");
  const std::vector<double> times_s = spread(law_times_s.front(), law_times_s.back(), count);
  return fitted(law, relaxation_points(law_times_s, ratios, times_s), times_s,
                fmt::format("a table of the relaxation modulus over {:g} to {:g} s",
                            law_times_s.front(), law_times_s.back()));
}

}  // namespace

Relaxation read_relaxation_law(const StudyTable& law) {
  const int count = law.count("branches");
  Relaxation found;
  if (law.has("order"))
    found = of_fractional(law, count);
  else if (law.has("frequencies"))
    found = of_dynamic(law, count);
  else if (law.has("times"))
    found = of_relaxation(law, count);
  else
    law.refuse("order",
               "expected a relaxation law: order, share and time, or frequencies, storage and "
               "loss, or times and moduli");
  law.finish();
  return found;
}

}  // namespace flexneck::pipeline
