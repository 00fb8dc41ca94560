// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "multibody/signals/cfc_filter.h"

namespace flexneck::pipeline {

/// Allowed range of a figure, its limits included.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  bool contains(double value) const { return value >= low && value <= high; }
};

/// Moment M = My - arm Fx about the occipital condyles, from the upper load cell's channels.
struct MomentDefinition {
  double arm_m = 0.0176784;  ///< 0.058 ft, as in 49 CFR 572.33
  multibody::ChannelClass force_filter = multibody::ChannelClass::cfc600;
  multibody::ChannelClass moment_filter = multibody::ChannelClass::cfc600;
};

/// Limits of the rotation of plane D relative to the pendulum, positive in the direction of flight
/// before the impact.
struct RotationRule {
  Limits peak_rad;
  std::optional<Limits> time_of_peak_s;
  std::optional<Limits> first_zero_crossing_s;  ///< in the rebound after the peak
};

/// Limits of the moment with the sign of SAE J211, which is negative in extension.
struct MomentRule {
  Limits peak_Nm;
  bool while_rotation_inside =
      false;  ///< the peak of the time when the rotation is within peak_rad
  std::optional<Limits> time_of_peak_s;
  double decay_to_Nm = 0;
  Limits time_of_decay_s;  ///< first time after the largest moment at which it has decayed to that
                           ///< value
};

/// Limits of a pulse by its deceleration at some times, optionally at all times after them, and by
/// the time when it first falls to a level after its peak.
struct DecelerationPulse {
  std::vector<double> times_s;
  std::vector<Limits> deceleration_m_s2;
  double highest_after_m_s2 = 0;
  double decay_to_m_s2 = 0;
  Limits time_of_decay_s;
};

/// Limits of a pulse by the velocity that the pendulum has lost at some times.
struct VelocityPulse {
  std::vector<double> times_s;
  std::vector<Limits> lost_m_s;
};

/// A pendulum test of head and neck by a regulation, in SI units. Times are counted from the first
/// contact of the pendulum with its decelerating device.
struct CertificationTest {
  enum class Direction { flexion, extension };
  std::string name;    ///< "572.33 flexion"
  std::string dummy;   ///< dummy that the test is for
  std::string source;  ///< source of its figures
  Direction direction = Direction::flexion;
  Limits impact_velocity_m_s;
  bool is_zeroed = false;  ///< rotation and moment are measured from their values at time zero
  MomentDefinition moment_definition;
  multibody::ChannelClass pendulum_filter = multibody::ChannelClass::cfc60;
  RotationRule rotation;
  MomentRule moment;
  std::variant<DecelerationPulse, VelocityPulse> pulse;
  std::string moment_unit = "N*m";  ///< unit in which the regulation's figures are shown
  std::string velocity_unit = "m/s";
};

}  // namespace flexneck::pipeline
