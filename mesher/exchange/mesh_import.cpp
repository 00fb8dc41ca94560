// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/mesh_import.h"

#include <algorithm>
#include <utility>

#include <Eigen/Core>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/file_survey.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/gmsh_import.h"
#include "mesher/exchange/import_check.h"
#include "mesher/exchange/inp_import.h"
#include "mesher/exchange/nastran_connections.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::mesher {
namespace {

bool is_inside(const std::array<double, 3>& x, const BoxSet& box) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(x[d] >= box.low_m[d] && x[d] <= box.high_m[d])) return false;
  }
  return true;
}

void add_box_sets(const std::vector<BoxSet>& boxes, Mesh& mesh) {
  if (boxes.empty()) return;
  const std::vector<Facet> boundary = boundary_facets(mesh);
  for (const BoxSet& box : boxes) {
    FaceSet faces = faces_among(boundary, box.name, [&](std::int32_t node) {
      return is_inside(mesh.nodes[static_cast<std::size_t>(node)], box);
    });
    if (faces.blocks.empty()) {
      throw InputError("set '" + box.name + "': no face of the surface lies in its box");
    }
    mesh.node_sets.push_back(nodes_of(faces));
    mesh.face_sets.push_back(std::move(faces));
  }
}

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
Mesh read_with_gmsh(const ImportOptions& options, LeftOut& left_out) {
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

Mesh read(const ImportOptions& options, const Progress& progress, LeftOut& left_out) {
  return foreign_format_of(options.file) == ForeignFormat::inp
             ? import_inp(options, progress, left_out)
             : read_with_gmsh(options, left_out);
}

/// The message begins with the file, unless it does already, with a line.
[[noreturn]] void rethrow(const std::filesystem::path& file, const InputError& error) {
  const std::string text = error.what();
  if (text.starts_with(file.string())) throw InputError(text);
  throw InputError(file.string() + ": " + text);
}

}  // namespace

Mesh import_mesh(const ImportOptions& options, const Progress& progress, const Progress& warn) {
  if (progress) progress("reading " + options.file.filename().string());
  try {
    LeftOut left_out;
    Mesh mesh = read(options, progress, left_out);
    add_box_sets(options.box_sets, mesh);
    check(mesh);
    check_import(mesh, options.keeps_doubles);
    if (warn && !left_out.empty()) warn(options.file.string() + ": " + left_out.text());
    return mesh;
  } catch (const InputError& error) {
    rethrow(options.file, error);
  }
}

}  // namespace flexneck::mesher
