// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/node_velocity.h"

#include <algorithm>
#include <string>

#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::mesher {
namespace {

bool same(const ElementBlock& a, const ElementBlock& b) {
  return a.part == b.part && a.kind == b.kind && a.nodes == b.nodes;
}

bool same(const FaceSet& a, const FaceSet& b) {
  return a.name == b.name &&
         std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(),
                    [](const FaceBlock& one, const FaceBlock& other) {
                      return one.kind == other.kind && one.nodes == other.nodes;
                    });
}

bool same(const Slit& a, const Slit& b) {
  return a.name == b.name && a.tied == b.tied && a.lower == b.lower && a.upper == b.upper;
}

/// Name of the first entry that differs; "their number" if only the numbers of entries differ.
template <typename Entry, typename NameOf>
std::string difference(const std::vector<Entry>& a, const std::vector<Entry>& b,
                       const NameOf& name_of) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (!same(a[k], b[k])) return "'" + name_of(a[k]) + "'";
  }
  return a.size() == b.size() ? "" : "their number";
}

}  // namespace

void require_same_topology(const Mesh& mesh, const Mesh& other) {
  const auto refuse = [](const std::string& what) {
    throw InputError("it changes the topology of the mesh (" + what + ")");
  };
  if (mesh.nodes.size() != other.nodes.size()) {
    refuse(std::to_string(mesh.nodes.size()) + " nodes become " +
           std::to_string(other.nodes.size()));
  }
  const auto name_of = [](const auto& entry) { return entry.name; };
  const auto part_of = [](const ElementBlock& block) { return block.part; };
  if (const auto part = difference(mesh.blocks, other.blocks, part_of); !part.empty())
    refuse("parts: " + part);
  if (const auto set = difference(mesh.face_sets, other.face_sets, name_of); !set.empty())
    refuse("face sets: " + set);
  if (const auto slit = difference(mesh.slits, other.slits, name_of); !slit.empty())
    refuse("slits: " + slit);
}

Eigen::Matrix3Xd node_velocity(const Mesh& mesh, const Mesh& below, const Mesh& above,
                               double width) {
  require_same_topology(mesh, below);
  require_same_topology(mesh, above);
  return (positions_of(above) - positions_of(below)) / width;
}

}  // namespace flexneck::mesher
