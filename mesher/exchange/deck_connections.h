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

/// A degree of freedom of a deck's node: components 1 to 3 are translations, 4 to 6 rotations.
struct DeckTerm {
  std::int64_t node = 0;
  int component = 0;
  double coefficient = 0;
};

/// Nodes that follow a node of the deck as a rigid body.
struct DeckCoupling {
  std::string name;
  std::int64_t reference = 0;
  std::int64_t rotation = 0;  ///< node whose translations are the rotations; 0 if none
  std::vector<std::int64_t> nodes;
  std::array<bool, 3> directions = {true, true, true};
};

/// A node that is fixed in some components.
struct DeckSupport {
  std::string name;
  std::int64_t node = 0;
  std::array<bool, 6> components{};
};

struct DeckEquation {
  std::string name;
  std::vector<DeckTerm> terms;  ///< their sum is zero; the first one is dependent
};

struct DeckSpring {
  std::string name;
  std::vector<DeckTerm> terms;  ///< their sum is the elongation
  double stiffness = 0;
  bool is_along_nodes = false;  ///< the spring acts along the line between the two nodes of its
                                ///< terms
};

struct DeckMass {
  std::string name;
  std::int64_t node = 0;
  double mass = 0;
  std::array<double, 3> center{};   ///< relative to the node
  std::array<double, 6> inertia{};  ///< about the centre: xx, yy, zz, xy, xz, yz of the tensor
};

/// Connections, supports and masses of a deck, in its numbers and units.
struct DeckConnections {
  std::vector<DeckCoupling> couplings;
  std::vector<DeckSupport> supports;
  std::vector<DeckEquation> equations;
  std::vector<DeckSpring> springs;
  std::vector<DeckMass> masses;
  std::map<std::int64_t, AxisSystem> axes;  ///< axes of a node's components; other nodes have the
                                            ///< global ones

  bool empty() const {
    return couplings.empty() && supports.empty() && equations.empty() && springs.empty() &&
           masses.empty();
  }
};

/// Positions of a deck's nodes, their numbers and the deck's units.
struct DeckNodes {
  std::map<std::int64_t, std::array<double, 3>> positions;  ///< positions of all nodes, in the
                                                            ///< deck's unit
  std::map<std::int64_t, std::int32_t> index_of;            ///< indices of nodes that elements use
  double length_unit_m = 1;
  double force_unit_N = 1;  ///< unit of force; the unit of time is the second
};

/// Adds the connections to the mesh. Nodes that no element uses become reference points if a
/// coupling, a mass, a spring or an equation has them.
/// @param left_out gets parts that a mesh cannot hold: rotations and inertias of nodes of solids,
/// which do not rotate
/// @return the nodes that no element uses but the mesh keeps
/// @throws InputError for nodes that the deck does not define, couplings without nodes or of other
/// points, equations with rotations of nodes of solids, springs between translations and rotations.
std::set<std::int64_t> add_connections(const DeckConnections& deck, const DeckNodes& nodes,
                                       Mesh& mesh, LeftOut& left_out);

}  // namespace flexneck::mesher
