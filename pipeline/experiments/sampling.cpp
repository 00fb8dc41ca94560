// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/sampling.h"

#include <cmath>
#include <vector>

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
  constexpr double kRounding = 1e-9;  // 0.5 ms is five tenths of a millisecond, not six
  return std::max(
      1, static_cast<int>(std::ceil(output_interval_s / kSamplingInterval_s * (1 - kRounding))));
}

Eigen::VectorXd thinned(const Eigen::VectorXd& signal, int every) {
  return signal(kept(signal.size(), every));
}

History thinned(const History& history, int every) {
  const std::vector<Index> indices = kept(history.time_s.size(), every);
  const auto thin = [&](auto& values) {
    if (values.size() == 0) return;
    if constexpr (std::decay_t<decltype(values)>::ColsAtCompileTime == 1)
      values = values(indices).eval();
    else
      values = values(Eigen::all, indices).eval();
  };
  History result = history;
  thin(result.time_s);
  for (multibody::MarkerHistory& marker : result.markers) {
    thin(marker.position_m);
    thin(marker.velocity_m_s);
    thin(marker.acceleration_m_s2);
    thin(marker.rotation);
    thin(marker.angular_velocity_rad_s);
    thin(marker.angular_acceleration_rad_s2);
  }
  for (multibody::JointHistory& joint : result.joints) {
    thin(joint.force_N);
    thin(joint.moment_Nm);
  }
  for (multibody::ModalHistory& body : result.modal) thin(body.coordinates);
  for (Eigen::VectorXd* const energy :
       {&result.energy.kinetic_J, &result.energy.gravitational_J, &result.energy.strain_J,
        &result.energy.dissipated_J, &result.energy.work_J, &result.constraints.position_m,
        &result.constraints.orientation_rad, &result.constraints.velocity_m_s,
        &result.constraints.angular_velocity_rad_s})
    thin(*energy);
  return result;
}

}  // namespace flexneck::pipeline
