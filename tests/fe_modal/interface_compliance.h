// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <string>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// The average motion of a face set, three translations and three rotations about a point, as rows
/// over the degrees of freedom of the free nodes.
inline Eigen::MatrixXd average_motion(const mesher::Mesh& mesh, const std::string& face_set,
                                      const Eigen::Vector3d& point_m, const DofMap& dof_map) {
  Eigen::MatrixXd average(6, dof_map.dof_count());
  const auto weights =
      RigidAverage(mesh, mesh.face_set(face_set), point_m).weights(dof_map.node_count());
  for (std::size_t i = 0; i < 6; ++i)
    average.row(static_cast<Eigen::Index>(i)) = dof_map.gather(weights[i]).transpose();
  return average;
}

/// Compliance of an interface under unit forces and moments on itself, as the sum over the modes.
inline Eigen::MatrixXd modal_compliance(const ModalBody& body, const std::string& interface) {
  const Interface& at = body.interface(interface);
  Eigen::MatrixXd motions(6, body.mode_count());
  motions << at.translation, at.rotation;
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  return motions * omega.cwiseAbs2().cwiseInverse().asDiagonal() * motions.transpose();
}

/// Largest difference of two compliances, each entry relative to the size from the diagonal, so
/// that metres and radians compare.
inline double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (found - expected) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

}  // namespace flexneck::fe_modal
