// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/checked_import.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "mesher/exchange/import_check.h"
#include "mesher/mesh/boundary.h"

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
      throw InputError("set '" + box.name + "': no face of the surface lies in the box");
    }
    mesh.node_sets.push_back(nodes_of(faces));
    mesh.face_sets.push_back(std::move(faces));
  }
}

/// Rethrows an error with the file's name in front, unless the message already begins with the file
/// and line.
[[noreturn]] void rethrow(const std::filesystem::path& file, const InputError& error) {
  const std::string text = error.what();
  if (text.starts_with(file.string())) throw InputError(text);
  throw InputError(file.string() + ": " + text);
}

}  // namespace

Mesh checked_import(const ImportOptions& options, MeshReader read, const Progress& progress,
                    const Progress& warn) {
  if (progress) progress("reading " + options.file.filename().string());
  try {
    LeftOut left_out;
    Mesh mesh = read(options, progress, left_out);
    left_out.require_named(options.leave_out);
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
