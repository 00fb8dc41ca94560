// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/signals/cfc_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSamplesPerClass = 10;
/// Ratio of the design frequency to the class, J211-1 annex C.
constexpr double kDesign = 2.0775;

/// y_k = a0 x_k + a1 x_k-1 + a2 x_k-2 + b1 y_k-1 + b2 y_k-2.
struct Recursion {
  double a0, a1, a2, b1, b2;
};

Recursion butterworth(double design_Hz, double interval_s) {
  const double w = std::tan(std::numbers::pi * design_Hz * interval_s);
  const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
  const double a0 = w * w * scale;
  return {a0, 2 * a0, a0, -2 * (w * w - 1) * scale, (-1 + std::numbers::sqrt2 * w - w * w) * scale};
}

/// Filters in place; the initial state assumes that the signal always had the value of the first
/// sample.
void run(const Recursion& recursion, VectorXd& x) {
  double x1 = x[0];
  double x2 = x[0];
  double y1 = x[0];
  double y2 = x[0];
  for (double& sample : x) {
    const double y = recursion.a0 * sample + recursion.a1 * x1 + recursion.a2 * x2 +
                     recursion.b1 * y1 + recursion.b2 * y2;
    x2 = x1;
    x1 = sample;
    y2 = y1;
    y1 = y;
    sample = y;
  }
}

void check(const VectorXd& signal, double interval_s, double cfc) {
  if (!(interval_s > 0) || interval_s * cfc * kSamplesPerClass > 1 + 1e-9)
    throw InputError("CFC " + rounded_text(cfc) + " needs at least " +
                     rounded_text(kSamplesPerClass * cfc) +
                     " samples per second (SAE J211), but the interval is " +
                     rounded_text(interval_s) + " s; record the history at shorter intervals");
  if (signal.size() < 2 || !signal.allFinite())
    throw InputError("a signal to be filtered needs at least two samples, all finite");
}

}  // namespace

std::string name_of(ChannelClass channel_class) {
  return "CFC " + std::to_string(static_cast<int>(channel_class));
}

VectorXd cfc_filtered(const VectorXd& signal, double interval_s, ChannelClass cfc) {
  const double number = static_cast<double>(cfc);
  check(signal, interval_s, number);
  const double design_Hz = kDesign * number;
  const Index count = signal.size();
  const auto wanted = static_cast<Index>(10 / (2 * std::numbers::pi * design_Hz * interval_s)) + 1;
  const Index pad = std::min(wanted, count - 1);
  VectorXd padded(count + 2 * pad);
  for (Index k = 0; k < pad; ++k) {
    padded[k] = 2 * signal[0] - signal[pad - k];
    padded[pad + count + k] = 2 * signal[count - 1] - signal[count - 2 - k];
  }
  padded.segment(pad, count) = signal;
  const Recursion recursion = butterworth(design_Hz, interval_s);
  run(recursion, padded);
  padded.reverseInPlace();
  run(recursion, padded);
  padded.reverseInPlace();
  return padded.segment(pad, count);
}

}  // namespace flexneck::multibody
