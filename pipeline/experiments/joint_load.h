// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/history/history.h"
#include "multibody/model/model.h"

namespace flexneck::pipeline {

/// All that the lower body of a joint exerts on the upper one, in the axes of marker i: the
/// reaction, which a history holds, and what the springs, dampers and stops on a pin's angle do,
/// which it does not (multibody/CONVENTIONS.md, signs).
struct JointLoad {
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;  ///< about marker j's origin
};

/// @param history  of the model's run
/// @param joint    among the model's joints
JointLoad joint_load(const multibody::Model& model, const multibody::History& history,
                     std::size_t joint);

}  // namespace flexneck::pipeline
