// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/facet_key.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// The elements that touch the faces of some cuts, in the order of the mesh. They are found in one
/// pass; all further work uses only these.
struct CutSurroundings {
  /// A node on a cut as one local node of one of the elements there.
  struct Incidence {
    std::int32_t node;
    std::uint32_t local;  ///< index among the element's nodes
  };
  struct Element {
    std::size_t block, number;
    std::size_t first_incidence;  ///< its incidences end where those of the next element begin
  };
  /// A facet with at least one node on a cut.
  struct KnownFacet {
    FacetKey key;
    std::uint32_t element;  ///< index into `elements`
    std::uint32_t side;     ///< index into facets_of()
  };
  /// A face of a cut.
  struct Face {
    FacetKey key;
    std::size_t cut;
  };

  CutSurroundings(const Mesh& mesh, const std::vector<const FaceSet*>& cuts);

  const ReferenceFacet& side_of(const KnownFacet& side) const;
  /// Incidences of an element's nodes on cuts.
  std::span<const Incidence> incidences_of(std::size_t element) const;
  /// Index of the incidence of a local node; incidences.size() if the node is on no cut.
  std::size_t incidence_at(std::size_t element, std::size_t local) const;
  /// The cut that has this face, or null.
  const Face* face_with(const FacetKey& key) const;

  const Mesh& mesh;
  std::vector<Face> faces;            ///< ascending by key
  std::vector<Element> elements;      ///< in the order of the mesh
  std::vector<Incidence> incidences;  ///< by element, then by local node
  std::vector<KnownFacet> sides;      ///< ascending by key, then in the order of the mesh

 private:
  std::vector<bool> nodes_on(const std::vector<const FaceSet*>& cuts);
  void collect_elements(const std::vector<bool>& on_cut);
  void collect_facets();
};

}  // namespace flexneck::mesher
