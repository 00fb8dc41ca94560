// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/block_mesh.h"

namespace flexneck::testing {

std::vector<std::int32_t> BlockMesh::faces_at(int k) const {
  std::vector<std::int32_t> faces;
  for (int ey = 0; ey < y_divisions; ++ey) {
    for (int ex = 0; ex < x_divisions; ++ex) {
      for (const auto& r : mesher::reference_nodes(mesher::ElementKind::quad9)) {
        faces.push_back(
            node(2 * ex + 1 + static_cast<int>(r[0]), 2 * ey + 1 + static_cast<int>(r[1]), k));
      }
    }
  }
  return faces;
}

mesher::Mesh BlockMesh::make() const {
  mesher::Mesh mesh;
  int layers = 0;
  for (const Slice& slice : slices) layers += slice.layers;
  for (int k = 0; k <= 2 * layers; ++k) {
    for (int j = 0; j < y_nodes(); ++j) {
      for (int i = 0; i <= 2 * x_divisions; ++i) {
        const Eigen::Vector3d x =
            position({i / (2.0 * x_divisions), j / (2.0 * y_divisions), k / (2.0 * layers)});
        mesh.nodes.push_back({x[0], x[1], x[2]});
      }
    }
  }
  int layer = 0;
  for (const Slice& slice : slices) {
    mesher::ElementBlock block;
    block.part = slice.part;
    block.material = mesh.materials.size();
    mesh.materials.push_back(slice.material);
    for (int ez = layer; ez < layer + slice.layers; ++ez) {
      for (int ey = 0; ey < y_divisions; ++ey) {
        for (int ex = 0; ex < x_divisions; ++ex) {
          for (const auto& r : mesher::reference_nodes(mesher::ElementKind::hex27)) {
            block.nodes.push_back(node(2 * ex + 1 + static_cast<int>(r[0]),
                                       2 * ey + 1 + static_cast<int>(r[1]),
                                       2 * ez + 1 + static_cast<int>(r[2])));
          }
        }
      }
    }
    layer += slice.layers;
    mesh.blocks.push_back(std::move(block));
  }
  for (const auto& [name, level] : {std::pair{"bottom", 0}, std::pair{"top", 2 * layers}}) {
    mesh.face_sets.push_back({name, {{mesher::ElementKind::quad9, faces_at(level)}}});
    mesher::NodeSet nodes{name, {}};
    for (std::int32_t k = node(0, 0, level); k < node(0, 0, level + 1); ++k) {
      nodes.nodes.push_back(k);
    }
    mesh.node_sets.push_back(std::move(nodes));
  }
  return mesh;
}

BlockMesh box(std::array<int, 3> divisions, const Eigen::Vector3d& size_m,
              const mesher::Material& material) {
  BlockMesh block;
  block.x_divisions = divisions[0];
  block.y_divisions = divisions[1];
  block.slices = {{"block", divisions[2], material}};
  block.position = [size_m](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return (p - Eigen::Vector3d(0.5, 0.5, 0)).cwiseProduct(size_m);
  };
  return block;
}

BlockMesh tube(std::array<int, 3> divisions, double inner_radius_m, double outer_radius_m,
               double height_m, const mesher::Material& material) {
  BlockMesh block = box(divisions, {1, 1, 1}, material);
  block.closed_in_y = true;
  block.position = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double radius = inner_radius_m + p[0] * (outer_radius_m - inner_radius_m);
    const double angle = 2 * std::numbers::pi * p[1];
    return {radius * std::cos(angle), radius * std::sin(angle), p[2] * height_m};
  };
  return block;
}

Eigen::Vector3d distorted(const Eigen::Vector3d& p) {
  return {p[0] + 0.10 * std::sin(2.1 * p[1] + 1.3 * p[2]) + 0.05 * p[0] * p[1],
          p[1] + 0.08 * std::sin(1.7 * p[2] + 2.3 * p[0]) - 0.06 * p[1] * p[2],
          p[2] + 0.09 * std::sin(2.7 * p[0] + 1.1 * p[1]) + 0.07 * p[2] * p[0]};
}

}  // namespace flexneck::testing
