// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "multibody/history/history.h"

namespace flexneck::pipeline {

/// Modal coordinates of the neck at a time of a run.
struct BentNeck {
  std::vector<Eigen::Index> modes;  ///< indices of the run's modes among the body's
  Eigen::VectorXd coordinates;
};

/// Modal coordinates at a time; none if the body lacks the run's modes.
/// @param time  index in the history
std::optional<BentNeck> bent_neck(const multibody::History& history,
                                  const fe_modal::ModalBody& body, Eigen::Index time);

/// Position of the joint point for these coordinates, neck frame, m.
Eigen::Vector3d joint_of(const fe_modal::ModalBody& body, const BentNeck& bent);

/// Rotation of the joint's frame about y, rad, positive forward.
double tip_angle(const fe_modal::ModalBody& body, const BentNeck& bent);

}  // namespace flexneck::pipeline
