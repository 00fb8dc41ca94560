// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/slits/cut_topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::mesher {
namespace {

constexpr std::int8_t kNoColour = -1;
constexpr std::int8_t kLower = 0;
constexpr std::int8_t kUpper = 1;

/// Calls what(side, next) for the facets that two elements share.
template <class What>
void for_each_shared_facet(const std::vector<CutSurroundings::KnownFacet>& sides,
                           const What& what) {
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s - 1].key == sides[s].key) what(sides[s - 1], sides[s]);
  }
}

}  // namespace

CutTopology::CutTopology(const CutSurroundings& surroundings, std::vector<std::string> names)
    : near_(surroundings),
      names_(std::move(names)),
      sets_(near_.incidences.size()),
      is_doubled_(near_.incidences.size(), false),
      colour_(near_.incidences.size(), kNoColour) {
  find_faces();
  link_elements_round_nodes();
  find_doubled_nodes();
  link_doubled_nodes_of_elements();
  tell_lips_apart();
}

void CutTopology::refuse(std::size_t cut, const std::string& problem, std::int32_t node) const {
  const auto& x = near_.mesh.nodes[static_cast<std::size_t>(node)];
  throw InputError("slit '" + names_[cut] + "': " + problem + " at (" + rounded_texts(x, 4) +
                   ") m");
}

void CutTopology::find_faces() {
  for (std::size_t f = 0; f < near_.faces.size(); ++f) {
    const CutSurroundings::Face& face = near_.faces[f];
    const std::int32_t corner = face.key.back();
    if (f > 0 && near_.faces[f - 1].key == face.key) {
      refuse(face.cut, "one of its faces occurs twice", corner);
    }
    const auto first = std::lower_bound(
        near_.sides.begin(), near_.sides.end(), face.key,
        [](const auto& side, const FacetKey& wanted) { return side.key < wanted; });
    const auto second = first == near_.sides.end() ? first : first + 1;
    if (second == near_.sides.end() || second->key != face.key) {
      refuse(face.cut,
             "a slit needs an element on both sides of its faces, found a face with only one",
             corner);
    }
    faces_.push_back({face.cut, &*first, &*second});
  }
}

void CutTopology::link_elements_round_nodes() {
  for_each_shared_facet(near_.sides, [&](const auto& a, const auto& b) {
    if (near_.face_with(a.key) != nullptr) return;
    const auto of_b = near_.incidences_of(b.element);
    for (const std::size_t local : near_.side_of(a).nodes) {
      const std::size_t incidence = near_.incidence_at(a.element, local);
      if (incidence == near_.incidences.size()) continue;
      for (std::size_t i = 0; i < of_b.size(); ++i) {
        if (of_b[i].node != near_.incidences[incidence].node) continue;
        sets_.join(incidence, near_.elements[b.element].first_incidence + i);
      }
    }
  });
}

std::vector<CutTopology::NodeOnCut> CutTopology::nodes_on_cuts() const {
  std::vector<NodeOnCut> nodes;
  for (const CutFace& face : faces_) {
    for (const std::size_t local : near_.side_of(*face.lower).nodes) {
      const std::size_t incidence = near_.incidence_at(face.lower->element, local);
      nodes.push_back({near_.incidences[incidence].node, face.cut});
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void CutTopology::find_doubled_nodes() {
  std::vector<std::size_t> by_node(near_.incidences.size());
  std::iota(by_node.begin(), by_node.end(), std::size_t{0});
  std::stable_sort(by_node.begin(), by_node.end(), [&](std::size_t a, std::size_t b) {
    return near_.incidences[a].node < near_.incidences[b].node;
  });
  const std::vector<NodeOnCut> nodes = nodes_on_cuts();
  std::size_t begin = 0;
  for (auto on_cut = nodes.begin(); on_cut != nodes.end(); ++on_cut) {
    const auto& [node, cut] = *on_cut;
    std::vector<std::size_t> roots;  // one for each group of connected elements
    std::size_t end = begin;
    for (; end < by_node.size() && near_.incidences[by_node[end]].node == node; ++end) {
      const std::size_t root = sets_.root(by_node[end]);
      if (std::find(roots.begin(), roots.end(), root) == roots.end()) roots.push_back(root);
    }
    if (roots.size() > 2) refuse(cut, "it meets or crosses a slit", node);
    if (roots.size() == 2) {
      if (const auto next = on_cut + 1; next != nodes.end() && next->first == node) {
        refuse(cut,
               "it shares nodes with slit '" + names_[next->second] + "'; make them one face set",
               node);
      }
      doubled_.push_back({cut, node});
      for (std::size_t i = begin; i < end; ++i) is_doubled_[by_node[i]] = true;
    }
    begin = end;
  }
  std::stable_sort(doubled_.begin(), doubled_.end(),
                   [](const DoubledNode& a, const DoubledNode& b) { return a.cut < b.cut; });
}

void CutTopology::link_doubled_nodes_of_elements() {
  for (std::size_t t = 0; t < near_.elements.size(); ++t) {
    const std::size_t first = near_.elements[t].first_incidence;
    const std::size_t last = first + near_.incidences_of(t).size();
    std::size_t earlier = last;
    for (std::size_t i = first; i < last; ++i) {
      if (!is_doubled_[i]) continue;
      if (earlier < last) sets_.join(earlier, i);
      earlier = i;
    }
  }
}

std::size_t CutTopology::lip_of(const CutSurroundings::KnownFacet& side) {
  for (const std::size_t local : near_.side_of(side).nodes) {
    const std::size_t incidence = near_.incidence_at(side.element, local);
    if (is_doubled_[incidence]) return sets_.root(incidence);
  }
  return near_.incidences.size();
}

std::vector<CutTopology::Across> CutTopology::lips_across_faces() {
  std::vector<Across> across;
  for (const CutFace& face : faces_) {
    const std::size_t a = lip_of(*face.lower);
    const std::size_t b = lip_of(*face.upper);
    if (a == near_.incidences.size()) continue;  // all its nodes lie on the tip
    if (a == b) {
      refuse(face.cut, "its two sides are connected at a place other than its inner edge",
             face.lower->key.back());
    }
    across.push_back({a, b, face.cut});
    across.push_back({b, a, face.cut});
  }
  std::sort(across.begin(), across.end());
  across.erase(std::unique(across.begin(), across.end()), across.end());
  return across;
}

void CutTopology::colour_from(std::size_t start, const std::vector<Across>& across) {
  colour_[start] = kLower;
  std::vector<std::size_t> front = {start};
  while (!front.empty()) {
    const std::size_t lip = front.back();
    front.pop_back();
    const auto opposite = static_cast<std::int8_t>(colour_[lip] == kLower ? kUpper : kLower);
    for (auto edge = std::lower_bound(across.begin(), across.end(), Across{lip, 0, 0});
         edge != across.end() && std::get<0>(*edge) == lip; ++edge) {
      const auto& [unused, other, cut] = *edge;
      if (colour_[other] == kNoColour) {
        colour_[other] = opposite;
        front.push_back(other);
      } else if (colour_[other] != opposite) {
        refuse(cut, "it does not separate two sides", near_.incidences[lip].node);
      }
    }
  }
}

void CutTopology::tell_lips_apart() {
  const std::vector<Across> across = lips_across_faces();
  // The smallest root belongs to the first element of the mesh.
  for (const auto& [lip, other, cut] : across) {
    if (colour_[lip] == kNoColour) colour_from(lip, across);
  }
  for (CutFace& face : faces_) {
    const std::size_t lip = lip_of(*face.lower);
    if (lip < colour_.size() && colour_[lip] == kUpper) std::swap(face.lower, face.upper);
  }
}

bool CutTopology::takes_copy(std::size_t incidence) {
  return is_doubled_[incidence] && colour_[sets_.root(incidence)] == kUpper;
}

}  // namespace flexneck::mesher
