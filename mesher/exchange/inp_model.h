// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesher/exchange/deck_connections.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/left_out.h"
#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Numbers of nodes or elements under a name, ascending.
struct InpSet {
  std::string name;  ///< as written where it first appears
  std::vector<std::int64_t> members;
  std::vector<std::int64_t> written;  ///< written out, not given by a range or another set
};
/// Sets by their names in capitals: the case of a name does not matter.
using InpSets = std::map<std::string, InpSet>;

struct InpElement {
  std::int64_t number = 0;
  ElementKind kind = ElementKind::hex20;
  std::vector<std::int64_t> nodes;  ///< numbers, in the order of Mesh
};

/// The facet S<n> of an element.
struct InpSide {
  std::int64_t element = 0;
  std::size_t side = 0;  ///< counted from 0
};

struct InpSurface {
  std::string name;
  std::vector<InpSide> sides;
};

/// A material in the units of the file; properties that the file does not give are empty.
struct InpMaterial {
  std::string name;
  std::optional<double> youngs_modulus;
  std::optional<double> poissons_ratio;
  std::optional<double> density;
};

struct InpSection {
  InpPlace place;
  std::string elset;
  std::string material;
};

/// The imported content of an Abaqus or CalculiX input.
struct InpModel {
  std::map<std::int64_t, std::array<double, 3>> nodes;  ///< in the unit of the file
  std::vector<InpElement> elements;                     ///< by number, ascending
  InpSets elsets;
  InpSets nsets;
  std::vector<std::string> element_elsets;  ///< ELSET= of *ELEMENT, in capitals, in the file's
                                            ///< order
  std::vector<InpSurface> surfaces;
  std::vector<InpMaterial> materials;
  std::vector<InpSection> sections;
  std::vector<std::int64_t> fixed;  ///< nodes that *BOUNDARY fixes in directions 1, 2 and 3
  DeckConnections connections;
  std::vector<std::string> ignored;          ///< keywords that were passed over, each once
  std::map<std::string, std::size_t> types;  ///< number of elements by TYPE=, in capitals
  LeftOut left_out;                          ///< loads, prestress, damping, undefined numbers
};

/// Reads *NODE, *ELEMENT (the types of abaqus_elements.h), *ELSET, *NSET, *SURFACE (of elements),
/// *MATERIAL with *ELASTIC (isotropic) and *DENSITY, *SOLID SECTION and the keywords of
/// inp_connections.h. Analysis steps and output requests are passed over; loads, prestress and
/// damping are left out and counted; keywords that would change the structure (ties, parts and
/// instances …) are refused, and so is every unknown keyword.
/// @throws InputError with file and line; for elements of other types: which, how many, where; for
/// sets and supports with written-out numbers that the file does not define.
InpModel read_inp(const std::filesystem::path& file, const std::string& text);

}  // namespace flexneck::mesher
