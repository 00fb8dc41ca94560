// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "mesher/drawing/outer_surface.h"
#include "mesher/drawing/raster.h"

namespace flexneck::mesher {

/// Direction of view: parallel projection, z upwards in the picture.
struct View {
  Eigen::Vector3d towards_eye{0.62, -0.72, 0.32};  ///< need not have unit length
};

/// Content of the picture of a body.
struct BodyPicture {
  Eigen::Matrix3Xd displacement_m;  ///< at the nodes, (3, n); empty if undeformed
  Eigen::VectorXd field;  ///< at the nodes, (n), 0 … 1 on the scale; empty for materials
  bool element_edges = true;
  bool undeformed_outline = false;
};

/// Draws the boundary of a mesh into a picture of the given size.
/// @param surface surface_of() this mesh
/// @param room_m space left for displacements around the bounding box of the mesh
Raster draw_body(const Mesh& mesh, const Surface& surface, const BodyPicture& what,
                 const View& view, int width, int height, double room_m = 0);

}  // namespace flexneck::mesher
