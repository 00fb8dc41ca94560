// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pulse_spectrum.h"

#include <cmath>
#include <numbers>

namespace flexneck::pipeline {

namespace {

using Complex = std::complex<double>;

/// Moments int u^n exp(-z u) du over [0, 1].
struct Moments {
  Complex zeroth, first;
};

Moments moments(Complex z) {
  // For smaller |z| the closed form loses more to cancellation than the truncated series.
  constexpr double kSmall = 1e-3;
  if (std::abs(z) < kSmall)
    return {1.0 - z / 2.0 + z * z / 6.0 - z * z * z / 24.0,
            0.5 - z / 3.0 + z * z / 8.0 - z * z * z / 30.0};
  const Complex decay = std::exp(-z);
  return {(1.0 - decay) / z, (1.0 - decay * (1.0 + z)) / (z * z)};
}

}  // namespace

Complex fourier_transform(const std::vector<double>& times_s, const std::vector<double>& values,
                          double frequency_Hz) {
  const Complex s(0, 2 * std::numbers::pi * frequency_Hz);
  Complex sum = 0;
  for (std::size_t k = 0; k + 1 < times_s.size(); ++k) {
    const double h = times_s[k + 1] - times_s[k];
    const Moments m = moments(s * h);
    sum += std::exp(-s * times_s[k]) * h *
           (values[k] * m.zeroth + (values[k + 1] - values[k]) * m.first);
  }
  return sum;
}

}  // namespace flexneck::pipeline
