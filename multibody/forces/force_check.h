// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/joints/joint.h"

namespace flexneck::multibody {

/// Parts of a model to which force elements refer.
struct ForceSites {
  std::vector<std::string> marker_bodies;  ///< name of the body of each marker
  const std::vector<Joint>& joints;
};

// Checks common to several kinds of force elements. `who` begins the message of the InputError
// thrown.

[[noreturn]] void refuse_force(const std::string& who, const std::string& problem);
void check_marker(const std::string& who, std::size_t marker, const ForceSites& sites);
/// Checks that the markers are two, on two bodies.
void check_pair(const std::string& who, std::size_t marker_i, std::size_t marker_j,
                const ForceSites& sites);
/// Checks that the vector has unit length.
void check_direction(const std::string& who, const Eigen::Vector3d& direction);
/// Checks that a stiffness or damping matrix is symmetric within rounding and has no negative
/// eigenvalue, which would feed energy.
void check_stiffness(const std::string& who, const std::string& what,
                     const Eigen::Ref<const Eigen::MatrixXd>& matrix);
void check_not_negative(const std::string& who, const std::string& what, double value);

}  // namespace flexneck::multibody
