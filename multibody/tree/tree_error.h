// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "multibody/numerics/error_estimate.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody::tree {

/// Measures the error of a tree's state, each part against "absolute + relative * reference", and
/// the largest ratio counts:
///
/// | part                | unit  | reference                                              |
/// |---------------------|-------|--------------------------------------------------------|
/// | joint's distances   | m     | the system's size                                      |
/// | joint's angles      | rad   | one radian                                             |
/// | joint's rates       | m/s   | the fastest joint's, angles by the system's size       |
/// | deformation, its rate | m, m/s | their amplitude, as StateError measures it          |
class TreeError {
 public:
  /// @param tree  must outlive this
  TreeError(const Tree& tree, double relative, double absolute);

  ErrorEstimate operator()(const Eigen::VectorXd& begin, const Eigen::VectorXd& end,
                           const Eigen::VectorXd& error) const;
  /// Name of a component, e.g. "rate of joint 'head'".
  std::string name_of(std::size_t component) const;

 private:
  double fastest_joint(const Eigen::VectorXd& state) const;

  const Tree& tree_;
  Tolerance tolerance_;
};

}  // namespace flexneck::multibody::tree
