// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

#include <Eigen/Core>

#include "multibody/history/history.h"

namespace flexneck::multibody {

/// True if an array has one entry per time, false if it has one column.
template <class Array>
inline constexpr bool kIsOnePerTime = std::remove_cvref_t<Array>::ColsAtCompileTime == 1;

/// Calls visit(array) for each array of a history with a column, or an entry, per time.
/// @param history  const or not
template <class AnyHistory, class Visit>
void visit_arrays(AnyHistory& history, const Visit& visit) {
  visit(history.time_s);
  for (auto& marker : history.markers) {
    for (auto* each : {&marker.position_m, &marker.velocity_m_s, &marker.acceleration_m_s2,
                       &marker.angular_velocity_rad_s, &marker.angular_acceleration_rad_s2})
      visit(*each);
    visit(marker.rotation);
  }
  for (auto& joint : history.joints) {
    visit(joint.force_N);
    visit(joint.moment_Nm);
  }
  for (auto& angle : history.angles) visit(angle.angle_rad);
  for (auto& modal : history.modal) visit(modal.coordinates);
  for (auto& body : history.state.bodies) {
    for (auto* each : {&body.position_m, &body.velocity_m_s, &body.angular_velocity_rad_s})
      visit(*each);
    visit(body.rotation);
    visit(body.modal);
    visit(body.modal_rate);
  }
  if (!history.state.bodies.empty()) {
    visit(history.state.internal);
    visit(history.state.angles);
  }
  auto& energy = history.energy;
  auto& constraints = history.constraints;
  for (auto* part :
       {&energy.kinetic_J, &energy.gravitational_J, &energy.strain_J, &energy.dissipated_J,
        &energy.work_J, &constraints.position_m, &constraints.orientation_rad,
        &constraints.velocity_m_s, &constraints.angular_velocity_rad_s})
    visit(*part);
}

/// Number of values in each output of a history.
inline Eigen::Index numbers_per_output(const History& history) {
  Eigen::Index numbers = 0;
  visit_arrays(history, [&]<class Array>(const Array& values) {
    numbers += kIsOnePerTime<Array> ? 1 : values.rows();
  });
  return numbers;
}

}  // namespace flexneck::multibody
