// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A body between two rigid faces as an element of a chain: stiffness and mass in the motions of
/// its base and of its top, each translation (3) and rotation (3), body axes. SI units.
struct CondensedSection {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< reference point of the base's motion
  Eigen::Vector3d top_m = Eigen::Vector3d::Zero();
  /// (12 + g + s, 12 + g + s): after the motions the openings of slits, m, which are not below
  /// zero, and the sliding motions of their sides, m, where these are kept.
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(12, 12);
  Eigen::Index slides = 0;  ///< number s of kept sliding motions
  /// Mass with the slits shut.
  Eigen::Matrix<double, 12, 12> mass = Eigen::Matrix<double, 12, 12>::Zero();
};

/// Treatment of the sliding of slits: condensed without load, or kept as coordinates.
enum class Sliding { free, kept };

/// Static condensation (Guyan, AIAA J. 3 (1965) 380) of a body whose base is fixed and whose modes
/// are the static shapes of one interface, and of the motions of its slits: the base's rigid motion
/// and the modes become the motions of base and top and the openings. Sliding motions of slits
/// follow without load, or are kept for friction. Small motions about the undeformed shape.
/// @param base  the interface on the fixed nodes
/// @param top   the other interface
/// @throws InputError unless there are six modes and one for each motion of a slit, and unless they
/// move the top and the slits independently; for kept sliding in no slit or in several.
CondensedSection condense(const ModalBody& body, const std::string& base, const std::string& top,
                          Sliding sliding = Sliding::free);

/// Deviation of a face from rigid motion: among the body's motions that move the interface in one
/// of six ways with the slits shut, the largest rms distance of the face's nodes from the rigid
/// motion, over the rms of that motion.
/// @param nodes  those of the face, as indices among the body's nodes that have shapes
double warp_of_face(const ModalBody& body, const std::string& interface,
                    const std::vector<Eigen::Index>& nodes);

/// Mass that moves with one end of a section.
struct LumpedMass {
  double mass_kg = 0;
  Eigen::Vector3d first_moment_kg_m = Eigen::Vector3d::Zero();  ///< about the end's point
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();      ///< about that point
};

/// Lumped masses at base and top: each end has half of the mass that moves with both. Together they
/// have the mass, the centre and the inertia of the whole.
std::array<LumpedMass, 2> lumped_masses(const CondensedSection& section);

}  // namespace flexneck::fe_modal
