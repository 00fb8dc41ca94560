// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Looks for what steps would miss of the loads that are functions, which nothing is known of but
/// their values: along a step, with the motion between its ends, each component is sampled at the
/// resolution and compared with what the method makes of the values that it takes. So pulses in
/// time and bumps along the way are not stepped over, shorter steps meet them, and the error of
/// these is controlled as ever.
class LoadWatch {
 public:
  /// How a method interpolates a load between the ends of a step.
  enum class Method {
    six_stages,  ///< a polynomial through the stages of Dormand and Prince, to 1e-3 of the load
    ends         ///< a straight line, to 1e-2
  };

  /// @param forces  must outlive this; at the beginning of a step
  LoadWatch(const ForceSet& forces, double resolution_s);

  /// The motion of the last evaluation is that at the beginning of the next step.
  void begin();
  /// The motion of the last evaluation is that at the end of a step.
  /// @return 1 if the step may be accepted, or the share of its length that may do
  double share_seen(double begin_s, double length_s, Method method);
  /// Shorter steps are not looked at: what cut one down to this is a jump.
  bool is_blind_to(double length_s) const;
  /// The step that was looked at last is accepted: the next one begins at its end.
  void accept() { begin_.swap(end_); }

 private:
  using Load = Eigen::Matrix<double, 6, 1>;

  struct Motions {
    const RelativeMotion& begin;
    const RelativeMotion& end;
    double length_s;
    Eigen::Vector3d turn;  ///< from begin to end
    RelativeMotion at(double share) const;
  };

  void take(std::vector<RelativeMotion>& motions) const;
  std::size_t first_missed(const FunctionForce& force, const Motions& motions, double begin_s,
                           std::size_t count, Method method, Load& largest);

  const ForceSet& forces_;
  double resolution_s_;
  std::vector<RelativeMotion> begin_, end_;
  std::vector<Load> largest_;  ///< that each force has shown, by component
  std::vector<Load> samples_;
};

}  // namespace flexneck::multibody
