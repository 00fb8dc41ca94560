// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/mesh/disjoint_sets.h"
#include "mesher/slits/cut_surroundings.h"

namespace flexneck::mesher {

/// A node that a cut splits in two.
struct DoubledNode {
  std::size_t cut = 0;
  std::int32_t node = 0;
};

/// A face of a cut as a facet of the elements below and above it.
struct CutFace {
  std::size_t cut = 0;
  const CutSurroundings::KnownFacet* lower = nullptr;
  const CutSurroundings::KnownFacet* upper = nullptr;
};

/// Topology of the elements around cuts. Elements around a node on a cut are connected by the
/// facets that are no face of a cut. A node whose elements fall into two groups is doubled. All
/// elements connected around doubled nodes form one lip of a cut, the lower or the upper one.
class CutTopology {
 public:
  /// @param names of the cuts, for messages
  /// @throws InputError as open_slits() does.
  CutTopology(const CutSurroundings& surroundings, std::vector<std::string> names);

  /// The doubled nodes, sorted by cut, then by node.
  const std::vector<DoubledNode>& doubled() const { return doubled_; }
  /// The faces of all cuts, sorted by key.
  const std::vector<CutFace>& faces() const { return faces_; }
  /// Returns whether an incidence belongs to a doubled node on the upper lip.
  bool takes_copy(std::size_t incidence);

 private:
  using NodeOnCut = std::pair<std::int32_t, std::size_t>;            ///< node, cut
  using Across = std::tuple<std::size_t, std::size_t, std::size_t>;  ///< lip, lip opposite, cut

  void find_faces();
  void link_elements_round_nodes();
  std::vector<NodeOnCut> nodes_on_cuts() const;
  void find_doubled_nodes();
  void link_doubled_nodes_of_elements();
  std::vector<Across> lips_across_faces();
  void colour_from(std::size_t start, const std::vector<Across>& across);
  void tell_lips_apart();
  std::size_t lip_of(const CutSurroundings::KnownFacet& side);
  [[noreturn]] void refuse(std::size_t cut, const std::string& problem, std::int32_t node) const;

  const CutSurroundings& near_;
  std::vector<std::string> names_;
  DisjointSets sets_;  ///< over incidences
  std::vector<CutFace> faces_;
  std::vector<DoubledNode> doubled_;
  std::vector<bool> is_doubled_;     ///< by incidence
  std::vector<std::int8_t> colour_;  ///< by incidence that represents a lip
};

}  // namespace flexneck::mesher
