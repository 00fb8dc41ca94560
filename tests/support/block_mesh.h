// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::testing {

/// A slice of a structured block: a number of layers of elements in z, of one material.
struct Slice {
  std::string part;
  int layers = 1;
  mesher::Material material;
};

/// Structured block of 27-node hexahedra on the grid u, v, w in [0, 1]^3, for tests.
struct BlockMesh {
  int x_divisions = 1;
  int y_divisions = 1;
  std::vector<Slice> slices;  ///< from w = 0 to 1, all layers equally thick in w
  /// Position of the grid point (u, v, w).
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> position;
  bool closed_in_y = false;  ///< v = 1 is joined to v = 0: a ring

  /// Makes the mesh. Face and node sets "bottom" and "top" lie at w = 0 and 1.
  mesher::Mesh make() const;

 private:
  int y_nodes() const { return 2 * y_divisions + (closed_in_y ? 0 : 1); }
  std::int32_t node(int i, int j, int k) const {
    return ((k * y_nodes()) + j % y_nodes()) * (2 * x_divisions + 1) + i;
  }
  std::vector<std::int32_t> faces_at(int k) const;
};

/// Box of one material, centred on the z axis, from z = 0 to its height; its part is "block".
BlockMesh box(std::array<int, 3> divisions, const Eigen::Vector3d& size_m,
              const mesher::Material& material);

/// Round tube about the z axis, from z = 0 to its height; its part is "block".
BlockMesh tube(std::array<int, 3> divisions, double inner_radius_m, double outer_radius_m,
               double height_m, const mesher::Material& material);

/// A smooth map of the unit cube that moves every node, and bends edges and faces.
Eigen::Vector3d distorted(const Eigen::Vector3d& p);

}  // namespace flexneck::testing
