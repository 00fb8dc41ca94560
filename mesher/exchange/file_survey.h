// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string_view>

#include "mesher/exchange/left_out.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// What a file says by its own text. gmsh's readers of .bdf and .unv pass over in silence what they
/// do not know, so that what they read has to be compared with this.
struct FileSurvey {
  std::map<std::size_t, std::size_t> solids;  ///< number of nodes to number of elements
  std::size_t nodes = 0;
  bool has_connections = false;  ///< of a .bdf: cards that nastran_connections.h reads
};

/// Of Nastran's bulk data. Counted as left out is every card but nodes, solids, materials (the
/// study gives them), properties, coordinate systems, the control of an analysis and what
/// nastran_connections.h reads; so is a PARAM,WTMASS, with which densities are weights. Shells and
/// bars in a file that gmsh wrote are the faces and curves of sets.
/// @throws InputError with the line where the solids would come out wrong: nodes in coordinate
/// systems of their own, INCLUDE, replicated cards, tabs in fixed fields, solids without some of
/// their midside nodes.
FileSurvey survey_nastran(std::string_view text, LeftOut& left_out);

/// Of an I-deas universal file. Counted as left out are the data sets of restraints, loads and the
/// like, springs, masses and rigid elements; beams and shells where the file has properties for
/// them, otherwise they are the curves and faces of sets. A data set 164 whose unit of length is
/// not the one given leaves a remark.
/// @param length_unit_m as the study has it
FileSurvey survey_unv(std::string_view text, double length_unit_m, LeftOut& left_out);

/// @throws InputError if the mesh has not all solid elements of the file.
void compare_with(const Mesh& mesh, const FileSurvey& survey);

}  // namespace flexneck::mesher
