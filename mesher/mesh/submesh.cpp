// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/submesh.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace flexneck::mesher {
namespace {

/// The blocks of a submesh, whose node indices are still those of the whole mesh.
std::vector<ElementBlock> blocks_of(const Mesh& whole, const PieceOfElement& piece_of_element,
                                    std::int32_t piece) {
  std::vector<ElementBlock> blocks;
  std::size_t element = 0;
  for (const ElementBlock& block : whole.blocks) {
    ElementBlock own{block.part, block.kind, block.material, {}};
    const std::size_t width = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e, ++element) {
      if (piece_of_element[element] != piece) continue;
      const auto nodes = std::span(block.nodes).subspan(e * width, width);
      own.nodes.insert(own.nodes.end(), nodes.begin(), nodes.end());
    }
    if (!own.nodes.empty()) blocks.push_back(std::move(own));
  }
  return blocks;
}

void number_nodes(const Mesh& whole, MeshPiece& piece) {
  std::vector<std::int32_t> number(whole.nodes.size(), -1);
  for (const ElementBlock& block : piece.mesh.blocks) {
    for (const std::int32_t node : block.nodes) number[static_cast<std::size_t>(node)] = 0;
  }
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<std::int32_t>(piece.nodes.size());
    piece.nodes.push_back(static_cast<std::int32_t>(n));
    piece.mesh.nodes.push_back(whole.nodes[n]);
  }
  for (ElementBlock& block : piece.mesh.blocks) {
    for (std::int32_t& node : block.nodes) node = number[static_cast<std::size_t>(node)];
  }
}

void keep_used_materials(const Mesh& whole, Mesh& mesh) {
  std::map<std::size_t, std::size_t> own;
  for (ElementBlock& block : mesh.blocks) {
    const auto [entry, is_new] = own.emplace(block.material, own.size());
    if (is_new) mesh.materials.push_back(whole.materials[block.material]);
    block.material = entry->second;
  }
}

}  // namespace

MeshPiece submesh(const Mesh& whole, const PieceOfElement& piece_of_element, std::int32_t piece) {
  MeshPiece result;
  result.mesh.blocks = blocks_of(whole, piece_of_element, piece);
  number_nodes(whole, result);
  keep_used_materials(whole, result.mesh);
  return result;
}

}  // namespace flexneck::mesher
