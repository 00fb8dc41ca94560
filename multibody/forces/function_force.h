// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// Motion of marker j relative to the moving frame of marker i, in i's axes, SI.
struct RelativeMotion {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< j's axes to i's
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
};

RelativeMotion relative_motion(const MarkerKinematics& i, const MarkerKinematics& j);

/// Load on j's body at j's origin, in i's axes; the opposite acts on i's body at that point.
struct FunctionLoad {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
};

/// A load that is an arbitrary function of time and of the motion between two markers, such as a
/// formula or a prototype's own code. Only the values of the function are known: the energy it
/// gives to the bodies counts as external work, and it has no potential. Steps are shortened where
/// it has features that they would miss (time/load_watch.h).
struct FunctionForce {
  static constexpr std::string_view kName = "function_force";
  using Function = std::function<FunctionLoad(double time_s, const RelativeMotion& motion)>;

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  /// The function. Several threads may call it at once if they run the same model.
  Function load;
  /// True if it uses the rotation vector, which jumps at half a turn.
  bool takes_rotation_vector = false;
  /// Times at which steps end, increasing.
  std::vector<double> breakpoints_s = {};

  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  bool resists_turning() const { return takes_rotation_vector; }
  /// @throws ComputationError if the function's value is not finite.
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
