// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/sampling.h"

#include <cmath>
#include <vector>

#include "multibody/history/history_arrays.h"

namespace flexneck::pipeline {

using Eigen::Index;
using multibody::History;

namespace {

std::vector<Index> kept(Index count, int every) {
  std::vector<Index> indices;
  for (Index k = 0; k < count; k += every) indices.push_back(k);
  if (!indices.empty() && indices.back() != count - 1) indices.push_back(count - 1);
  return indices;
}

}  // namespace

int samples_per_output(double output_interval_s) {
  constexpr double kRounding = 1e-9;  // so that 0.5 ms has five intervals of 0.1 ms, not six
  return std::max(
      1, static_cast<int>(std::ceil(output_interval_s / kSamplingInterval_s * (1 - kRounding))));
}

Eigen::VectorXd thinned(const Eigen::VectorXd& signal, int every) {
  return signal(kept(signal.size(), every));
}

History thinned(const History& history, int every) {
  const std::vector<Index> indices = kept(history.time_s.size(), every);
  History result = history;
  multibody::visit_arrays(result, [&]<class Array>(Array& values) {
    if ((multibody::kIsOnePerTime<Array> ? values.size() : values.cols()) == 0) return;
    // Swapped: if memory runs out, a matrix that Eigen resizes frees its values twice.
    Array fewer;
    if constexpr (multibody::kIsOnePerTime<Array>)
      fewer = values(indices);
    else
      fewer = values(Eigen::all, indices);
    values.swap(fewer);
  });
  return result;
}

}  // namespace flexneck::pipeline
