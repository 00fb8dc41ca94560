// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/descriptor/system.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// Measures the error of a state. For each body there are six components, each against its own
/// tolerance "absolute + relative * reference", and the largest ratio counts:
/// | part                 | unit | reference                                                 |
/// |----------------------|------|-----------------------------------------------------------|
/// | origin               | m    | the system's size, so that the world's origin is immaterial |
/// | rotation             | rad  | one radian                                                |
/// | its velocity         | m/s  | its speed, or that of the line below if it is larger      |
/// | angular velocity times the system's size | m/s | of the body that turns or deforms fastest |
/// | deformation, its rate | m, m/s | their present amplitude                                |
/// Deformations, of unit kg^(1/2) m, are divided by the root of the body's mass: with
/// mass-normalised modes that is the root mean square displacement of the body's mass. Their
/// amplitude is taken over position and velocity (of each mode, a and adot / omega), so that the
/// tolerance does not collapse where a vibration passes through zero.
class StateError {
 public:
  /// @param system  must outlive this
  StateError(const System& system, double relative, double absolute);

  ErrorEstimate operator()(const Eigen::VectorXd& begin, const Eigen::VectorXd& end,
                           const Eigen::VectorXd& error) const;
  /// Name of a component, e.g. "rotation of body 'head'".
  std::string name_of(std::size_t component) const;

 private:
  double fastest(const Eigen::VectorXd& state) const;

  const System& system_;
  Tolerance tolerance_;
};

}  // namespace flexneck::multibody
