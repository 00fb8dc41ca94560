// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model.h"

namespace flexneck::multibody {

/// The motion of a driven body: exact, by the integrals of its table and of its function of time.
struct DrivenPath {
  Pose start;
  DrivenBody body;

  Eigen::Vector3d position_m(double time_s) const;
  Eigen::Vector3d velocity_m_s(double time_s) const;
  Eigen::Vector3d acceleration_m_s2(double time_s) const;
};

/// How driven bodies move.
enum class Drive {
  prescribed,  ///< as their tables say
  held         ///< not at all, where they are at the time asked for
};

}  // namespace flexneck::multibody
