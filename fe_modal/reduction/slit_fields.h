// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// A relative motion of the two sides of a slit: displacement of its upper side relative to the
/// lower one, for an amplitude of one.
struct SlitField {
  std::string name;
  bool opens = true;       ///< true for jumps along the normals; false for sliding across them
  std::size_t slit = 0;    ///< index in the mesh
  Eigen::Matrix3Xd jumps;  ///< jumps of its pairs, (3, p), the largest of length 1
};

/// Finds the relative motions of the sides of slits that static shapes of the open body contain.
/// Each slit has two openings, or one if the shapes have only one: the edges of the cone of all
/// openings without overlap that the two strongest combinations of the shapes can make, so that any
/// sum of them with amplitudes >= 0 keeps the sides apart, and no other of their sums does. As they
/// open, the sides move across the normals as those of a crack do. With sliding, each independent
/// field of the shapes' jumps across the normals is a further motion.
/// @param shapes  shapes of the open body, (3, n) each, K-orthonormal, so that their jumps compare
/// @throws InputError for a slit that the shapes do not open
std::vector<SlitField> slit_fields(const mesher::Mesh& mesh,
                                   const std::vector<Eigen::Matrix3Xd>& shapes, bool with_sliding);

/// Field on all nodes, (3, n): zero except on the slit's upper side.
Eigen::Matrix3Xd on_nodes(const mesher::Mesh& mesh, const SlitField& field);

/// Amplitudes of the modes in each field.
/// @param shapes  shapes of the modes, (3, n) each, whose jumps are sums of the fields
std::vector<SlitMotion> slit_motions(const mesher::Mesh& mesh, const std::vector<SlitField>& fields,
                                     const std::vector<Eigen::Matrix3Xd>& shapes);

}  // namespace flexneck::fe_modal
