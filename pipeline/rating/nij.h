// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// What a dummy's neck is measured by: 49 CFR 571.208, in-position. The limits of the force apart
/// from Nij are not among them.
struct NeckIntercepts {
  std::string_view name;
  double tension_N, compression_N;  ///< magnitudes
  double flexion_Nm, extension_Nm;  ///< magnitudes
  double condyle_arm_m;             ///< from the upper load cell down to the condyles
};

inline constexpr std::array<NeckIntercepts, 2> kNeckIntercepts = {{
    {"50th-male", 6806, 6160, 310, 135, 0.01778},
    {"5th-female", 4287, 3880, 155, 67, 0.01778},
}};

/// @throws InputError for a name that is not in the table; the message lists all.
const NeckIntercepts& neck_intercepts(const std::string& dummy);

/// Loads at the occipital condyles by the signs of SAE J211, at equidistant times.
struct CondyleLoads {
  Eigen::VectorXd force_z_N;    ///< shape (n); positive is tension
  Eigen::VectorXd moment_y_Nm;  ///< shape (n); positive is flexion
  double interval_s = 0;
  bool is_filtered = false;  ///< both by CFC 600 already
};

/// Moment at the condyles of what an upper load cell reads, both by the signs of SAE J211:
/// My - arm Fx.
Eigen::VectorXd condyle_moment(const Eigen::VectorXd& force_x_N, const Eigen::VectorXd& moment_y_Nm,
                               double arm_m);

struct NijPeak {
  std::string_view name;         ///< "NTE" to "NCF"
  std::string_view combination;  ///< "tension, extension" to "compression, flexion"
  double value = 0;              ///< largest over the time; 0 if the loads never combine so
  Eigen::Index sample = 0;
  double force_N = 0, moment_Nm = 0;  ///< filtered, at that sample
};

/// Fz / F_intercept + My / M_intercept of loads filtered by CFC 600, largest of each combination.
/// A time belongs to the combination of the signs that its force and moment have; a load that is
/// zero counts for both.
/// Nij is defined for a dummy in a vehicle, not for the neck pendulum; which of the two loads come
/// from they do not tell.
/// @throws InputError for loads of unequal length and as multibody::cfc_filtered() does.
std::array<NijPeak, 4> nij(const CondyleLoads& loads, const NeckIntercepts& intercepts);

}  // namespace flexneck::pipeline
