// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/verdict/samples.h"

#include <stdexcept>

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

void check_samples(const VectorXd& time_s, const VectorXd& signal) {
  if (time_s.size() != signal.size() || time_s.size() < 2)
    throw std::invalid_argument("a curve needs one value per time, and two or more");
  if (!time_s.allFinite() || !signal.allFinite())
    throw std::invalid_argument("a curve must be finite");
  for (Index k = 1; k < time_s.size(); ++k)
    if (!(time_s[k] > time_s[k - 1])) throw std::invalid_argument("times must increase");
}

std::optional<double> value_at(const VectorXd& time_s, const VectorXd& signal, double at_s) {
  if (at_s < time_s[0] || at_s > time_s[time_s.size() - 1]) return {};
  Index k = 1;
  while (time_s[k] < at_s) ++k;
  const double share = (at_s - time_s[k - 1]) / (time_s[k] - time_s[k - 1]);
  return (1 - share) * signal[k - 1] + share * signal[k];
}

std::optional<double> first_fall(const VectorXd& time_s, const VectorXd& signal, double level,
                                 double from_s) {
  for (Index k = 1; k < time_s.size(); ++k) {
    if (time_s[k] < from_s || signal[k] > level || signal[k - 1] <= level) continue;
    const double share = (signal[k - 1] - level) / (signal[k - 1] - signal[k]);
    return time_s[k - 1] + share * (time_s[k] - time_s[k - 1]);
  }
  return {};
}

}  // namespace flexneck::pipeline
