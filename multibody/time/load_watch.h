// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Detects features that steps would miss in loads given by functions, of which only the values are
/// known: along a step, with the motion between its ends, each component is sampled at the
/// resolution and compared with the method's interpolation of the values that it uses. So pulses in
/// time and bumps along the path are not stepped over: shorter steps meet them, whose error is
/// controlled as usual.
class LoadWatch {
 public:
  /// Interpolation of a load between the ends of a step by a method.
  enum class Method {
    six_stages,  ///< a polynomial through the stages of Dormand and Prince, to 1e-3 of the load
    ends         ///< a straight line, to 1e-2
  };

  /// @param forces  evaluated at the beginning of a step; must outlive this
  LoadWatch(const ForceSet& forces, double resolution_s);

  /// Takes the motion of the last evaluation as that at the beginning of the next step.
  void begin();
  /// Takes the motion of the last evaluation as that at the end of a step, and checks the step.
  /// @return 1 if the step may be accepted, or the fraction of its length to try next
  double share_seen(double begin_s, double length_s, Method method);
  /// Returns whether steps of this length are not checked: one that was shortened to it contains a
  /// jump.
  bool is_blind_to(double length_s) const;
  /// Accepts the step that was checked last: the next one begins at its end.
  void accept() { begin_.swap(end_); }

 private:
  using Load = Eigen::Matrix<double, 6, 1>;

  struct Motions {
    const RelativeMotion& begin;
    const RelativeMotion& end;
    double length_s;
    Eigen::Vector3d turn;  ///< rotation vector from begin to end
    RelativeMotion at(double share) const;
  };

  void take(std::vector<RelativeMotion>& motions) const;
  std::size_t first_missed(const FunctionForce& force, const Motions& motions, double begin_s,
                           std::size_t count, Method method, Load& largest);

  const ForceSet& forces_;
  double resolution_s_;
  std::vector<RelativeMotion> begin_, end_;
  std::vector<Load> largest_;  ///< largest loads of each force so far, by component
  std::vector<Load> samples_;
};

}  // namespace flexneck::multibody
