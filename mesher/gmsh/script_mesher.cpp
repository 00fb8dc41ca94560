// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/script_mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include <gmsh.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "mesher/exchange/script_files.h"
#include "mesher/gmsh/gmsh_mesh_import.h"
#include "mesher/gmsh/gmsh_session.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/slits/slits.h"

namespace flexneck::mesher {
namespace {

void report(const Progress& progress, const std::string& line) {
  if (progress) progress(line);
}

void open_script(GmshSession& session, const std::filesystem::path& script) {
  const std::string errors = session.errors_of([&] { gmsh::open(script.string()); });
  if (!errors.empty())
    throw InputError(script.string() + ": gmsh reports errors in the script: " + errors);
}

/// Refuses scaling factors: gmsh applies them when it writes files, not to the mesh that its API
/// returns.
void refuse_scaling(const std::filesystem::path& script) {
  for (const std::string option : {"Mesh.ScalingFactor", "Geometry.ScalingFactor"}) {
    double factor = 1;
    gmsh::option::getNumber(option, factor);
    if (factor == 1) continue;
    throw InputError(script.string() + ": " + option + " = " + rounded_text(factor) +
                     " has no effect here; remove it, and give the unit of length of the script in "
                     "geometry.unit");
  }
}

/// ONELAB names of the constants that the script declares, by the constant's own name: the part of
/// the ONELAB name after the last '/'.
std::map<std::string, std::string> declared_constants() {
  std::vector<std::string> names;
  gmsh::onelab::getNames(names);
  std::map<std::string, std::string> declared;
  for (const std::string& name : names) {
    const bool is_of_gmsh = name.starts_with("Gmsh/");  // gmsh's own information on the model
    if (!is_of_gmsh) declared[name.substr(name.rfind('/') + 1)] = name;
  }
  return declared;
}

/// The ONELAB name of a constant.
/// @throws InputError if the script does not declare the constant.
std::string onelab_name(const std::map<std::string, std::string>& declared,
                        const std::string& constant, const std::filesystem::path& script) {
  std::vector<std::string> names;
  names.reserve(declared.size());
  for (const auto& [name, unused] : declared) names.push_back(name);
  try {
    return declared.at(names[find_name(names, constant, "declared constant")]);
  } catch (const InputError& error) {
    throw InputError(script.string() + ": " + error.what() +
                     "; gmsh lists only constants that have a Name, such as " + "DefineConstant[" +
                     constant + " = {1, Name \"Parameters/" + constant + "\"}]");
  }
}

/// Runs the script. Only after a run are the constants that it declares known, so it runs again
/// with their values.
void run_script(GmshSession& session, const ScriptMeshOptions& options) {
  if (!std::ifstream(options.script).good()) {
    throw InputError(options.script.string() + ": the geometry script cannot be read");
  }
  note_script_files(options.script);
  open_script(session, options.script);
  refuse_scaling(options.script);
  if (options.constants.empty()) return;

  const auto declared = declared_constants();
  for (const auto& [name, value] : options.constants) {
    gmsh::onelab::setNumber(onelab_name(declared, name, options.script), {value});
  }
  gmsh::clear();
  open_script(session, options.script);
  refuse_scaling(options.script);
}

void require_meshable(const ScriptMeshOptions& options) {
  constexpr std::array kOffered = {ElementKind::hex27, ElementKind::hex20, ElementKind::hex8,
                                   ElementKind::tet10};
  if (!options.element ||
      std::find(kOffered.begin(), kOffered.end(), *options.element) != kOffered.end()) {
    return;
  }
  throw InputError("expected an element hex27, hex20, hex8 or tet10 for a script, found " +
                   std::string(name_of(*options.element)));
}

void generate(GmshSession& session, const ScriptMeshOptions& options) {
  const ElementKind element = options.element.value_or(ElementKind::hex27);
  const std::string errors = session.errors_of([&] {
    gmsh::option::setNumber("Mesh.ElementOrder", order_of(element));
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", element == ElementKind::hex20 ? 1 : 0);
    if (element == ElementKind::tet10) {
      gmsh::option::setNumber("Mesh.RecombineAll", 0);
      gmsh::option::setNumber("Mesh.Recombine3DAll", 0);
      gmsh::option::setNumber("Mesh.Algorithm3D", 1);  // other algorithms differ from run to run
    }
    gmsh::model::mesh::generate(3);
  });
  if (!errors.empty()) {
    throw InputError(options.script.string() + ": gmsh cannot mesh it: " + errors);
  }
}

void require_wanted_kind(const Mesh& mesh, const ScriptMeshOptions& options) {
  if (!options.element) return;
  const auto is_wanted = [&](const ElementBlock& block) { return block.kind == *options.element; };
  if (std::any_of(mesh.blocks.begin(), mesh.blocks.end(), is_wanted)) return;
  throw InputError(options.script.string() + ": the script makes elements of kind " +
                   std::string(name_of(mesh.blocks.front().kind)) + ", but mesh.element is " +
                   std::string(name_of(*options.element)) +
                   "; hexahedra require Recombine Surface in the script");
}

Mesh imported_mesh(const ScriptMeshOptions& options) {
  try {
    Mesh mesh = import_gmsh_mesh(options.materials, options.material_of_part);
    for (auto& node : mesh.nodes) {
      for (double& x : node) x *= options.length_unit_m;
    }
    return mesh;
  } catch (const InputError& error) {
    throw InputError(options.script.string() + ": " + error.what());
  }
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

[[noreturn]] void refuse_patch(const NodePatches& patches, const std::array<double, 3>& centre,
                               double nearest_m) {
  throw InputError("node set '" + patches.name + "': no node of face set '" + patches.face_set +
                   "' lies within " + rounded_text(patches.radius_m, 4) + " m of (" +
                   rounded_texts(centre, 4) + ") m, the nearest is " + rounded_text(nearest_m, 4) +
                   " m away; increase the radius or refine the mesh");
}

NodeSet patch_nodes(const Mesh& mesh, const NodePatches& patches) {
  NodeSet set{.name = patches.name, .nodes = {}};
  const NodeSet& candidates = mesh.node_set(patches.face_set);
  for (const auto& centre : patches.centres_m) {
    const std::size_t before = set.nodes.size();
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const std::int32_t node : candidates.nodes) {
      const double away_m = distance(mesh.nodes[static_cast<std::size_t>(node)], centre);
      nearest_m = std::min(nearest_m, away_m);
      if (away_m <= patches.radius_m) set.nodes.push_back(node);
    }
    if (set.nodes.size() == before) refuse_patch(patches, centre, nearest_m);
  }
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  return set;
}

}  // namespace

Mesh mesh_script(const ScriptMeshOptions& options, const Progress& progress, const Progress& warn) {
  require_meshable(options);
  Mesh mesh;
  {
    GmshSession session;
    report(progress, "gmsh " GMSH_API_VERSION " runs " + options.script.filename().string());
    run_script(session, options);
    generate(session, options);
    for (const std::string& failure : session.failures())
      report(warn, options.script.string() + ": gmsh: " + failure + "; check the free memory");
    report(progress, "gmsh has finished; importing the mesh");
    mesh = imported_mesh(options);
  }
  require_wanted_kind(mesh, options);
  open_slits(mesh, options.slits, options.slits_tied);
  for (const NodePatches& patches : options.patches) {
    mesh.node_sets.push_back(patch_nodes(mesh, patches));
  }
  check(mesh);
  require_sound_elements(mesh);
  report(progress, "mesh with " + std::to_string(mesh.nodes.size()) + " nodes in " +
                       std::to_string(mesh.blocks.size()) + " parts");
  return mesh;
}

}  // namespace flexneck::mesher
