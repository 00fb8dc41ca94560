// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/element_kind.h"

#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

constexpr std::array<std::array<double, 3>, 27> kHex27Nodes = {{
    // corners
    {-1, -1, -1},
    {1, -1, -1},
    {1, 1, -1},
    {-1, 1, -1},
    {-1, -1, 1},
    {1, -1, 1},
    {1, 1, 1},
    {-1, 1, 1},
    // edges
    {0, -1, -1},
    {-1, 0, -1},
    {-1, -1, 0},
    {1, 0, -1},
    {1, -1, 0},
    {0, 1, -1},
    {1, 1, 0},
    {-1, 1, 0},
    {0, -1, 1},
    {-1, 0, 1},
    {1, 0, 1},
    {0, 1, 1},
    // faces
    {0, 0, -1},
    {0, -1, 0},
    {-1, 0, 0},
    {1, 0, 0},
    {0, 1, 0},
    {0, 0, 1},
    // centre
    {0, 0, 0},
}};

constexpr std::array<std::array<double, 3>, 9> kQuad9Nodes = {{
    // corners
    {-1, -1, 0},
    {1, -1, 0},
    {1, 1, 0},
    {-1, 1, 0},
    // edges
    {0, -1, 0},
    {1, 0, 0},
    {0, 1, 0},
    {-1, 0, 0},
    // centre
    {0, 0, 0},
}};

/// All that is known of a kind: a new kind is one row here.
struct KindRecord {
  std::string_view name;
  int dimension;
  std::span<const std::array<double, 3>> nodes;
};

constexpr std::array<KindRecord, 2> kKinds = {{
    {"hex27", 3, kHex27Nodes},
    {"quad9", 2, kQuad9Nodes},
}};

const KindRecord& record_of(ElementKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

}  // namespace

std::string_view name_of(ElementKind kind) { return record_of(kind).name; }

ElementKind element_kind_from(std::string_view name) {
  std::string known;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    if (kKinds[k].name == name) return static_cast<ElementKind>(k);
    known += (k == 0 ? "" : ", ") + std::string(kKinds[k].name);
  }
  throw InputError("unknown element kind '" + std::string(name) + "', expected one of " + known);
}

std::span<const std::array<double, 3>> reference_nodes(ElementKind kind) {
  return record_of(kind).nodes;
}

int dimension(ElementKind kind) { return record_of(kind).dimension; }

}  // namespace flexneck::mesher
