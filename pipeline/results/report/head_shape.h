// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Ellipsoid drawn for the head: of uniform density, with the head's mass and inertia. Axes of the
/// head, origin at the occipital condyles.
struct HeadShape {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d semi_axes_m;
  Eigen::Quaterniond rotation;  ///< rotation from its principal axes to the head's
};

/// Shape of the study's rigid body "head"; none without that body.
std::optional<HeadShape> head_shape(const Study& study);

/// Outline of the shape seen along y: points (x, z) about its centre.
Eigen::Matrix2Xd outline_along_y(const HeadShape& shape, const Eigen::Matrix3d& head_to_view);

}  // namespace flexneck::pipeline
