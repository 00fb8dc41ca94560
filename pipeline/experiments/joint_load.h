// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/history/history.h"
#include "multibody/model/model.h"

namespace flexneck::pipeline {

/// Total load of a joint's lower body on the upper one, in the axes of marker i: the reaction,
/// which a history holds, and the loads of springs, dampers and stops on a revolute joint's angle,
/// which it does not (multibody/CONVENTIONS.md, signs).
struct JointLoad {
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;  ///< about marker j's origin
};

/// @param history  the model's run
/// @param joint    index among the model's joints
JointLoad joint_load(const multibody::Model& model, const multibody::History& history,
                     std::size_t joint);

}  // namespace flexneck::pipeline
