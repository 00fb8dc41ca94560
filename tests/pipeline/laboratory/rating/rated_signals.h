// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Core>

#include "tests/pipeline/laboratory/rating/plain_ratings.h"

namespace flexneck::testing {

inline Samples samples(const Eigen::VectorXd& curve) { return {curve.begin(), curve.end()}; }

/// A pulse sin^2 between two samples, zero elsewhere.
inline Eigen::VectorXd pulse(Eigen::Index count, double begin, double end) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double place = (static_cast<double>(k) - begin) / (end - begin);
    if (place > 0 && place < 1) values[k] = std::pow(std::sin(std::numbers::pi * place), 2);
  }
  return values;
}

inline Eigen::VectorXd sine(Eigen::Index count, double periods) {
  const double end = 2 * std::numbers::pi * periods;
  return Eigen::VectorXd::LinSpaced(count, 0, end).array().sin();
}

/// A ramp from 1 up by 1e-5 per sample: so flat that warping has no advantage. Moving the path by s
/// samples reduces the differences d by 1e-5 s over n samples, but adds s pairs of a cost of d^2:
/// there is no advantage while 2 n 1e-5 < d.
inline Eigen::VectorXd flat_ramp(Eigen::Index count) {
  return Eigen::VectorXd::LinSpaced(count, 1, 1 + 1e-5 * static_cast<double>(count - 1));
}

/// A sum of five sines of random amplitude, phase and 0.3 to 5 periods.
inline Eigen::VectorXd random_smooth(Eigen::Index count, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(count, share(random) - 0.5);
  for (int wave = 0; wave < 5; ++wave) {
    const double amplitude = share(random);
    const double phase = 2 * std::numbers::pi * share(random);
    const double turn = 2 * std::numbers::pi * (0.3 + 4.7 * share(random));
    const Eigen::ArrayXd angles = Eigen::ArrayXd::LinSpaced(count, phase, phase + turn);
    values.array() += amplitude * angles.sin();
  }
  return values;
}

}  // namespace flexneck::testing
