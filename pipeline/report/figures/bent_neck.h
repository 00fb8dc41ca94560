// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "multibody/history/history.h"

namespace flexneck::pipeline {

/// How the neck is bent at a time of a run.
struct BentNeck {
  std::vector<Eigen::Index> modes;  ///< of the run, among the body's
  Eigen::VectorXd coordinates;
};

/// @param time  its place in the history
/// None if the run has not these modes.
std::optional<BentNeck> bent_neck(const multibody::History& history,
                                  const fe_modal::ModalBody& body, Eigen::Index time);

/// Where that puts the joint point, neck frame, m.
Eigen::Vector3d joint_of(const fe_modal::ModalBody& body, const BentNeck& bent);

/// Rotation of the joint's frame about y, rad, positive forward.
double tip_angle(const fe_modal::ModalBody& body, const BentNeck& bent);

}  // namespace flexneck::pipeline
