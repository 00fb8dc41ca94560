// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/boundary.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace flexneck::mesher {
namespace {

FaceBlock& block_of(FaceSet& set, ElementKind kind) {
  const auto found = std::find_if(set.blocks.begin(), set.blocks.end(),
                                  [&](const FaceBlock& block) { return block.kind == kind; });
  if (found != set.blocks.end()) return *found;
  return set.blocks.emplace_back(FaceBlock{kind, {}});
}

}  // namespace

std::vector<FacetPlace> facets_by_key(const Mesh& mesh) {
  std::vector<FacetPlace> places;
  std::size_t number = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const std::size_t width = nodes_per_element(block.kind);
    const auto sides = facets_of(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e, ++number) {
      const auto nodes = std::span(block.nodes).subspan(e * width, width);
      for (std::size_t s = 0; s < sides.size(); ++s) {
        places.push_back({key_of_facet(sides[s], nodes), b, e, s, number});
      }
    }
  }
  std::sort(places.begin(), places.end(), [](const FacetPlace& a, const FacetPlace& b) {
    return std::tie(a.key, a.block, a.element, a.side) <
           std::tie(b.key, b.block, b.element, b.side);
  });
  return places;
}

Facet facet_at(const Mesh& mesh, const FacetPlace& place) {
  const ElementBlock& block = mesh.blocks[place.block];
  const ReferenceFacet& side = facets_of(block.kind)[place.side];
  Facet result{place.block, side.kind, {}};
  for (const std::size_t local : side.nodes) {
    result.nodes.push_back(block.nodes[place.element * nodes_per_element(block.kind) + local]);
  }
  return result;
}

std::vector<Facet> boundary_facets(const Mesh& mesh) {
  const std::vector<FacetPlace> places = facets_by_key(mesh);
  std::vector<FacetPlace> single;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const bool as_before = p > 0 && places[p].key == places[p - 1].key;
    const bool as_after = p + 1 < places.size() && places[p].key == places[p + 1].key;
    if (!as_before && !as_after) single.push_back(places[p]);
  }
  std::sort(single.begin(), single.end(), [](const FacetPlace& a, const FacetPlace& b) {
    return std::tie(a.block, a.element, a.side) < std::tie(b.block, b.element, b.side);
  });
  std::vector<Facet> result;
  result.reserve(single.size());
  for (const FacetPlace& place : single) result.push_back(facet_at(mesh, place));
  return result;
}

FaceSet faces_among(const std::vector<Facet>& sides, const std::string& name,
                    const std::function<bool(std::int32_t)>& is_wanted) {
  FaceSet set{.name = name, .blocks = {}};
  for (const Facet& side : sides) {
    if (!std::all_of(side.nodes.begin(), side.nodes.end(), is_wanted)) continue;
    std::vector<std::int32_t>& nodes = block_of(set, side.kind).nodes;
    nodes.insert(nodes.end(), side.nodes.begin(), side.nodes.end());
  }
  return set;
}

}  // namespace flexneck::mesher
