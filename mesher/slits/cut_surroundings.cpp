// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/slits/cut_surroundings.h"

#include <algorithm>
#include <tuple>

namespace flexneck::mesher {

CutSurroundings::CutSurroundings(const Mesh& m, const std::vector<const FaceSet*>& cuts) : mesh(m) {
  collect_elements(nodes_on(cuts));
  collect_facets();
}

std::vector<bool> CutSurroundings::nodes_on(const std::vector<const FaceSet*>& cuts) {
  std::vector<bool> on_cut(mesh.nodes.size(), false);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    for (const FaceBlock& block : cuts[c]->blocks) {
      const std::size_t n = nodes_per_element(block.kind);
      for (std::size_t f = 0; f < block.size(); ++f) {
        faces.push_back({key_of_face(block.kind, std::span(block.nodes).subspan(f * n, n)), c});
      }
      for (const std::int32_t node : block.nodes) on_cut[static_cast<std::size_t>(node)] = true;
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.key, a.cut) < std::tie(b.key, b.cut);
  });
  return on_cut;
}

void CutSurroundings::collect_elements(const std::vector<bool>& on_cut) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const std::size_t first = incidences.size();
      for (std::size_t local = 0; local < n; ++local) {
        const std::int32_t node = block.nodes[e * n + local];
        if (!on_cut[static_cast<std::size_t>(node)]) continue;
        incidences.push_back({node, static_cast<std::uint32_t>(local)});
      }
      if (incidences.size() > first) elements.push_back({b, e, first});
    }
  }
}

void CutSurroundings::collect_facets() {
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const Element& element = elements[t];
    const ElementBlock& block = mesh.blocks[element.block];
    const std::size_t n = nodes_per_element(block.kind);
    const auto nodes = std::span(block.nodes).subspan(element.number * n, n);
    const std::span<const ReferenceFacet> all = facets_of(block.kind);
    for (std::size_t s = 0; s < all.size(); ++s) {
      const auto on_cut = [&](std::size_t local) {
        return incidence_at(t, local) < incidences.size();
      };
      if (std::none_of(all[s].nodes.begin(), all[s].nodes.end(), on_cut)) continue;
      sides.push_back({key_of_facet(all[s], nodes), static_cast<std::uint32_t>(t),
                       static_cast<std::uint32_t>(s)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const KnownFacet& a, const KnownFacet& b) {
    return std::tie(a.key, a.element, a.side) < std::tie(b.key, b.element, b.side);
  });
}

const ReferenceFacet& CutSurroundings::side_of(const KnownFacet& side) const {
  return facets_of(mesh.blocks[elements[side.element].block].kind)[side.side];
}

std::span<const CutSurroundings::Incidence> CutSurroundings::incidences_of(
    std::size_t element) const {
  const std::size_t first = elements[element].first_incidence;
  const std::size_t last =
      element + 1 < elements.size() ? elements[element + 1].first_incidence : incidences.size();
  return std::span(incidences).subspan(first, last - first);
}

std::size_t CutSurroundings::incidence_at(std::size_t element, std::size_t local) const {
  const auto own = incidences_of(element);
  const auto found = std::lower_bound(
      own.begin(), own.end(), local,
      [](const Incidence& incidence, std::size_t wanted) { return incidence.local < wanted; });
  if (found == own.end() || found->local != local) return incidences.size();
  return elements[element].first_incidence + static_cast<std::size_t>(found - own.begin());
}

const CutSurroundings::Face* CutSurroundings::face_with(const FacetKey& key) const {
  const auto found =
      std::lower_bound(faces.begin(), faces.end(), key,
                       [](const Face& face, const FacetKey& wanted) { return face.key < wanted; });
  return found != faces.end() && found->key == key ? &*found : nullptr;
}

}  // namespace flexneck::mesher
