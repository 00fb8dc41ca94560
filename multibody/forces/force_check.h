// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/joints/joint.h"

namespace flexneck::multibody {

/// What of a model force elements refer to.
struct ForceSites {
  std::vector<std::string> marker_bodies;  ///< of each marker, the name of its body
  const std::vector<Joint>& joints;
};

// What several kinds of force elements demand. `who` begins the message of the InputError thrown.

[[noreturn]] void refuse_force(const std::string& who, const std::string& problem);
void check_marker(const std::string& who, std::size_t marker, const ForceSites& sites);
/// Two markers, on two bodies.
void check_pair(const std::string& who, std::size_t marker_i, std::size_t marker_j,
                const ForceSites& sites);
/// A unit vector.
void check_direction(const std::string& who, const Eigen::Vector3d& direction);
/// Of a stiffness or a damping: symmetric within rounding, and no negative eigenvalue, since it
/// must not feed energy.
void check_stiffness(const std::string& who, const std::string& what,
                     const Eigen::Ref<const Eigen::MatrixXd>& matrix);
void check_not_negative(const std::string& who, const std::string& what, double value);

}  // namespace flexneck::multibody
