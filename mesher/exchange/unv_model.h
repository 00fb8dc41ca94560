// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/exchange/left_out.h"
#include "mesher/exchange/numbered_mesh.h"

namespace flexneck::mesher {

/// An element with the number of its table of material properties.
struct UnvElement {
  NumberedElement element;
  std::int64_t material = 0;
};

/// Nodes and elements with a common name.
struct UnvGroup {
  std::string name;
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> elements;
};

/// The imported content of an I-deas universal file.
struct UnvModel {
  NumberedMesh mesh;  ///< nodes only
  std::vector<UnvElement> solids;
  std::vector<UnvElement> faces;  ///< shells
  std::vector<UnvGroup> groups;   ///< groups of the same name are merged
};

/// Reads the data sets 2411 (nodes), 2412 (elements) and 2435, 2452, 2467 and 2477 (groups). Data
/// sets of restraints, loads and the like, older groups, springs, masses and rigid elements are
/// counted as left out; so are beams and shells if the file has properties for them, otherwise they
/// are the curves and faces of sets. A data set 164 with another unit of length than the given one
/// leaves a remark. Source of the formats: Universal File Datasets, SDRC, collected by the
/// University of Cincinnati.
/// @param length_unit_m the study's unit of length
/// @throws InputError with the line for lines that do not fit the data set, solid elements of other
/// kinds, repeated elements.
UnvModel read_unv(std::string_view text, double length_unit_m, LeftOut& left_out);

}  // namespace flexneck::mesher
