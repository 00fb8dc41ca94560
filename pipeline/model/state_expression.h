// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>

#include "multibody/forces/function_force.h"

namespace flexneck::pipeline {

/// Six components of a load, each written as a text such as "-40 * x - 3 * vx" (expression.h): of t
/// in s and of the motion of one marker seen from another, in its axes: x, y, z in m, vx, vy, vz in
/// m/s, the rotation vector rx, ry, rz in rad, and wx, wy, wz in rad/s. Copies share the parsers,
/// which one thread at a time uses.
class StateExpression {
 public:
  using Texts = std::array<std::string, 6>;  ///< Fx, Fy, Fz, Mx, My, Mz; an empty one is zero

  /// The names of the components in messages, as in files.
  static constexpr std::array<const char*, 6> kNames = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

  /// @throws InputError for what cannot be read: where, and what is wrong.
  explicit StateExpression(const Texts& texts);
  multibody::FunctionLoad operator()(double time_s, const multibody::RelativeMotion& motion) const;
  const Texts& texts() const { return texts_; }
  /// Whether one of them has rx, ry or rz.
  bool takes_rotation_vector() const;

 private:
  struct Impl;
  Texts texts_;
  std::shared_ptr<Impl> impl_;
};

}  // namespace flexneck::pipeline
