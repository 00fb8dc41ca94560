// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// A way in which a slit parts: what its upper side moves beyond the lower one, for an amplitude of
/// one.
struct SlitField {
  std::string name;
  bool opens = true;       ///< along the normals; else across them
  std::size_t slit = 0;    ///< among the mesh's
  Eigen::Matrix3Xd jumps;  ///< of its pairs, (3, p), the largest of length 1
};

/// The ways that static shapes of the open body show. Of each slit two openings, or one where there
/// is but one: the edges of the cone of all openings without overlap that the two strongest
/// combinations of the shapes can make, so that any sum of them with amplitudes >= 0 keeps the
/// sides apart, and none other of their sums does. As they open, the sides move across the normals
/// as those of a crack do. With sliding, besides, all that the shapes move the sides across the
/// normals, each independent field one way.
/// @param shapes  of the open body, (3, n) each, K-orthonormal, so that their jumps compare
/// @throws InputError for a slit that the shapes do not open
std::vector<SlitField> slit_fields(const mesher::Mesh& mesh,
                                   const std::vector<Eigen::Matrix3Xd>& shapes, bool with_sliding);

/// The field on all nodes, (3, n): zero but on the slit's upper side.
Eigen::Matrix3Xd on_nodes(const mesher::Mesh& mesh, const SlitField& field);

/// What the modes have of each field.
/// @param shapes  of the modes, (3, n) each, whose jumps are sums of the fields
std::vector<SlitMotion> slit_motions(const mesher::Mesh& mesh, const std::vector<SlitField>& fields,
                                     const std::vector<Eigen::Matrix3Xd>& shapes);

}  // namespace flexneck::fe_modal
