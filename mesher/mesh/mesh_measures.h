// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Size and shape of the elements of a block, from the Jacobian dx/dxi at the points of the rule of
/// strength three and at the nodes.
struct BlockMeasure {
  double volume_m3 = 0;  ///< exact for the second-order shape
  /// Smallest triple product of the unit directions along the edges that meet in a corner, divided
  /// by that of the ideal element: 1 for a box, a regular tetrahedron and an upright equilateral
  /// prism, 0 or less for an element that is degenerate or inverted.
  double smallest_scaled_jacobian = 0;
  std::size_t worst_element = 0;  ///< element with the smallest scaled Jacobian
  /// Largest ratio of an element's longest edge to its shortest, corner to corner.
  double max_aspect_ratio = 0;
};

BlockMeasure measure(const Mesh& mesh, const ElementBlock& block);
/// The scaled Jacobian of each element of a block.
std::vector<double> scaled_jacobians(const Mesh& mesh, const ElementBlock& block);

/// Area of curved faces in m^2.
double area_m2(const Mesh& mesh, const FaceBlock& faces);
double area_m2(const Mesh& mesh, const FaceSet& faces);

/// Checks the shape of all elements.
/// @throws ComputationError naming the part, the element and its position if an element is inverted
/// or degenerate.
void require_sound_elements(const Mesh& mesh);

}  // namespace flexneck::mesher
