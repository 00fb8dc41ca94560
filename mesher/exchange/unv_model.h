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

/// Nodes and elements under a name.
struct UnvGroup {
  std::string name;
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> elements;
};

/// The datasets that we take from an I-deas universal file.
struct UnvModel {
  NumberedMesh mesh;  ///< nodes alone
  std::vector<UnvElement> solids;
  std::vector<UnvElement> faces;  ///< shells
  std::vector<UnvGroup> groups;   ///< those of one name are one
};

/// Reads the data sets 2411 (nodes), 2412 (elements) and 2435, 2452, 2467 and 2477 (groups).
/// Counted as left out are the data sets of restraints, loads and the like, older groups, springs,
/// masses and rigid elements; beams and shells where the file has properties for them, otherwise
/// they are the curves and faces of sets. A data set 164 whose unit of length is not the one given
/// leaves a remark. Source of the formats: Universal File Datasets, SDRC, collected by the
/// University of Cincinnati.
/// @param length_unit_m as the study has it
/// @throws InputError with the line for lines that are not as the data set asks, solid elements of
/// other kinds, elements that come twice.
UnvModel read_unv(std::string_view text, double length_unit_m, LeftOut& left_out);

}  // namespace flexneck::mesher
