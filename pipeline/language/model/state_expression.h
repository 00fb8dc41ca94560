// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>

#include "multibody/forces/function_force.h"

namespace flexneck::pipeline {

/// Six components of a load, each written as a text such as "-40 * x - 3 * vx" (expression.h):
/// functions of t in s and of the motion of one marker relative to another, in the latter's axes:
/// x, y, z in m, vx, vy, vz in m/s, the rotation vector rx, ry, rz in rad, and wx, wy, wz in rad/s.
/// Copies share the parsers, which one thread at a time uses.
class StateExpression {
 public:
  using Texts = std::array<std::string, 6>;  ///< Fx, Fy, Fz, Mx, My, Mz; an empty text is zero

  /// Names of the components in messages and files.
  static constexpr std::array<const char*, 6> kNames = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

  /// @throws InputError with place and reason for an invalid text.
  explicit StateExpression(const Texts& texts);
  multibody::FunctionLoad operator()(double time_s, const multibody::RelativeMotion& motion) const;
  const Texts& texts() const { return texts_; }
  /// True if a component uses rx, ry or rz.
  bool takes_rotation_vector() const;

 private:
  struct Impl;
  Texts texts_;
  std::shared_ptr<Impl> impl_;
};

}  // namespace flexneck::pipeline
