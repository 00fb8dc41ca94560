// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Critical intercepts of a dummy's neck: 49 CFR 571.208, in-position. The separate limits of the
/// force are not included.
struct NeckIntercepts {
  std::string_view name;
  double tension_N, compression_N;  ///< magnitudes
  double flexion_Nm, extension_Nm;  ///< magnitudes
  double condyle_arm_m;             ///< distance from the upper load cell down to the condyles
};

inline constexpr std::array<NeckIntercepts, 2> kNeckIntercepts = {{
    {"50th-male", 6806, 6160, 310, 135, 0.01778},
    {"5th-female", 4287, 3880, 155, 67, 0.01778},
}};

/// Intercepts of a dummy.
/// @throws InputError for a name that is not in the table; the message lists all.
const NeckIntercepts& neck_intercepts(const std::string& dummy);

/// Loads at the occipital condyles with the signs of SAE J211, at equidistant times.
struct CondyleLoads {
  Eigen::VectorXd force_z_N;    ///< shape (n); positive is tension
  Eigen::VectorXd moment_y_Nm;  ///< shape (n); positive is flexion
  double interval_s = 0;
  bool is_filtered = false;  ///< true if both are filtered by CFC 600 already
};

/// Moment at the condyles from an upper load cell's readings, both with the signs of SAE J211: My -
/// arm Fx.
Eigen::VectorXd condyle_moment(const Eigen::VectorXd& force_x_N, const Eigen::VectorXd& moment_y_Nm,
                               double arm_m);

struct NijPeak {
  std::string_view name;         ///< "NTE" to "NCF"
  std::string_view combination;  ///< "tension, extension" to "compression, flexion"
  double value = 0;  ///< maximum over time; 0 if the loads never have these signs together
  Eigen::Index sample = 0;
  double force_N = 0, moment_Nm = 0;  ///< filtered, at that sample
};

/// Maximum over time of Fz / F_intercept + My / M_intercept for each combination, with the loads
/// filtered by CFC 600. A time belongs to the combination given by the signs of its force and
/// moment; a load that is zero counts for both. Nij is defined for a dummy in a vehicle, not for
/// the neck pendulum; the loads do not reveal their origin.
/// @throws InputError for loads of unequal length and as multibody::cfc_filtered() does.
std::array<NijPeak, 4> nij(const CondyleLoads& loads, const NeckIntercepts& intercepts);

}  // namespace flexneck::pipeline
