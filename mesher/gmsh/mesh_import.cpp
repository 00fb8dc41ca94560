// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/mesh_import.h"

#include <utility>

#include <Eigen/Core>

#include "geometry/foundation/error.h"
#include "mesher/exchange/checked_import.h"
#include "mesher/exchange/file_survey.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/inp_import.h"
#include "mesher/exchange/nastran_connections.h"
#include "mesher/gmsh/gmsh_import.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::mesher {
namespace {

/// gmsh keeps the numbers of nodes, and the mesh their order.
/// @return how many nodes that no element uses became reference points
std::size_t connect(std::string_view text, const ImportOptions& options, Mesh& mesh,
                    LeftOut& left_out) {
  NastranConnections read = read_nastran_connections(text, left_out);
  DeckNodes nodes{std::move(read.positions), {}, options.length_unit_m, options.force_unit_N};
  constexpr double kSame = 1e-6;
  const double tolerance_m = kSame * bounding_box(mesh).extent_m().norm();
  bool is_same = read.solid_nodes.size() == mesh.nodes.size();
  for (std::size_t n = 0; is_same && n < mesh.nodes.size(); ++n) {
    const auto found = nodes.positions.find(read.solid_nodes[n]);
    is_same = found != nodes.positions.end() &&
              (options.length_unit_m * Eigen::Vector3d(found->second.data()) -
               Eigen::Vector3d(mesh.nodes[n].data()))
                      .norm() <= tolerance_m;
    nodes.index_of[read.solid_nodes[n]] = static_cast<std::int32_t>(n);
  }
  if (!is_same) {
    throw InputError(
        "its couplings, supports, springs and masses cannot be placed: gmsh reads "
        "other nodes than its cards give");
  }
  return add_connections(read.deck, nodes, mesh, left_out).size();
}

/// gmsh reads the copy; a .bdf or .unv is read by us as well, for what gmsh passes over.
Mesh read_with_gmsh(const ImportOptions& options, const Progress& /*progress*/, LeftOut& left_out) {
  const CheckedCopy copy(options.file);
  FileSurvey survey;
  if (copy.format() == ForeignFormat::bdf) {
    survey = survey_nastran(checked_contents(copy.path()), left_out);
  } else if (copy.format() == ForeignFormat::unv) {
    survey = survey_unv(checked_contents(copy.path()), options.length_unit_m, left_out);
  }
  Mesh mesh = import_with_gmsh(copy, options, left_out);
  compare_with(mesh, survey);
  std::size_t used = mesh.nodes.size();
  if (survey.has_connections) {
    used += connect(checked_contents(copy.path()), options, mesh, left_out);
  }
  if (survey.nodes > used) left_out.add("nodes of no solid element", survey.nodes - used);
  return mesh;
}

}  // namespace

Mesh import_mesh(const ImportOptions& options, const Progress& progress, const Progress& warn) {
  const bool is_deck = foreign_format_of(options.file) == ForeignFormat::inp;
  return checked_import(options, is_deck ? import_inp : read_with_gmsh, progress, warn);
}

}  // namespace flexneck::mesher
