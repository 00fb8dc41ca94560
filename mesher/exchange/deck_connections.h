// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesher/exchange/left_out.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A degree of freedom of a deck's node: component 1 to 3 is a translation, 4 to 6 a rotation.
struct DeckTerm {
  std::int64_t node = 0;
  int component = 0;
  double coefficient = 0;
};

/// Nodes that follow a node of the deck as a rigid body.
struct DeckCoupling {
  std::string name;
  std::int64_t reference = 0;
  std::int64_t rotation = 0;  ///< a node whose translations are the rotations; 0: none
  std::vector<std::int64_t> nodes;
  std::array<bool, 3> directions = {true, true, true};
};

/// A node that does not move in some components.
struct DeckSupport {
  std::string name;
  std::int64_t node = 0;
  std::array<bool, 6> components{};
};

struct DeckEquation {
  std::string name;
  std::vector<DeckTerm> terms;  ///< whose sum is zero; the first one is dependent
};

struct DeckSpring {
  std::string name;
  std::vector<DeckTerm> terms;  ///< whose sum is the elongation
  double stiffness = 0;
  bool is_along_nodes = false;  ///< terms are two nodes: along the line between them
};

struct DeckMass {
  std::string name;
  std::int64_t node = 0;
  double mass = 0;
  std::array<double, 3> center{};   ///< from the node
  std::array<double, 6> inertia{};  ///< about the centre: xx, yy, zz, xy, xz, yz of the tensor
};

/// What a deck says beside nodes and elements, in its numbers and units.
struct DeckConnections {
  std::vector<DeckCoupling> couplings;
  std::vector<DeckSupport> supports;
  std::vector<DeckEquation> equations;
  std::vector<DeckSpring> springs;
  std::vector<DeckMass> masses;
  std::map<std::int64_t, AxisSystem> axes;  ///< of a node's components; others have the global ones

  bool empty() const {
    return couplings.empty() && supports.empty() && equations.empty() && springs.empty() &&
           masses.empty();
  }
};

/// Where a deck's nodes are, and how it counts.
struct DeckNodes {
  std::map<std::int64_t, std::array<double, 3>> positions;  ///< of all nodes, in the deck's unit
  std::map<std::int64_t, std::int32_t> index_of;            ///< of nodes that elements use
  double length_unit_m = 1;
  double force_unit_N = 1;  ///< the second is the unit of time
};

/// Adds them to the mesh. Nodes that no element uses become reference points where a coupling, a
/// mass, a spring or an equation has them.
/// @param left_out gets what cannot be: rotations and inertias of nodes of solids, which do not
/// rotate
/// @return the nodes that no element uses and the mesh has all the same
/// @throws InputError for nodes that the deck does not give, couplings without nodes or of other
/// points, equations with rotations of nodes of solids, springs between translations and rotations.
std::set<std::int64_t> add_connections(const DeckConnections& deck, const DeckNodes& nodes,
                                       Mesh& mesh, LeftOut& left_out);

}  // namespace flexneck::mesher
