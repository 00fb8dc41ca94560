// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesher/mesh/facet_key.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A facet of an element.
struct FacetPlace {
  FacetKey key{};
  std::size_t block = 0;
  std::size_t element = 0;  ///< within the block
  std::size_t side = 0;     ///< index into facets_of(the block's kind)
  std::size_t number = 0;   ///< element number, counted over all blocks
};

/// The facets of all elements in the order of their keys, so that those that meet are neighbours.
std::vector<FacetPlace> facets_by_key(const Mesh& mesh);

/// A facet of one volume element, its normal outwards.
struct Facet {
  std::size_t block = 0;
  ElementKind kind = ElementKind::quad9;
  std::vector<std::int32_t> nodes;
};
Facet facet_at(const Mesh& mesh, const FacetPlace& place);

/// The facets that belong to one element only, in the order of the elements: the boundary of the
/// body, open slits included.
std::vector<Facet> boundary_facets(const Mesh& mesh);

/// The facets whose nodes all satisfy `is_wanted`, in their order; no blocks if there are none.
FaceSet faces_among(const std::vector<Facet>& sides, const std::string& name,
                    const std::function<bool(std::int32_t)>& is_wanted);

}  // namespace flexneck::mesher
