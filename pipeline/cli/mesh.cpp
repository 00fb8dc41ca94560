// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/neck/neck_measures.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/mesh_result.h"
#include "pipeline/run/make_mesh.h"

namespace flexneck::pipeline {

namespace {

/// Exact volumes of the parts, which are known for the neck only.
ExactVolumes exact_volumes(const StructureSection& structure) {
  ExactVolumes volumes;
  if (!structure.neck) return volumes;
  for (const auto& part : measure_neck(structure).parts) volumes[part.part] = part.volume_m3;
  return volumes;
}

/// Estimated number of nodes, within a twentieth of the mesher's: the nodes per element in the
/// bulk, plus those at the surface that no neighbouring element shares.
double estimated_nodes(const NeckSection& neck, mesher::ElementKind element) {
  const double elements = geometry::hexahedra(neck.divisions);
  const double surface = std::pow(elements, 2.0 / 3);
  switch (element) {
    case mesher::ElementKind::hex8:
      return elements + 4.4 * surface;
    case mesher::ElementKind::hex20:
      return 4 * elements + 13.1 * surface;
    case mesher::ElementKind::tet10:
      return 24 * elements;
    default:
      return 8 * elements + 17.4 * surface;
  }
}

double estimated_bytes(double nodes) {
  constexpr double kProgram = 0.1e9;
  constexpr double kBytesPerNode = 400;  // measured with 9 000 to 200 000 nodes
  return kProgram + kBytesPerNode * nodes;
}

/// Text ": about 8.8e+03 nodes, 0.104 GB" for the neck, whose size is known before it is meshed.
/// @throws InputError if that is more than the available memory
std::string required_text(const StructureSection& structure) {
  if (!structure.neck) return {};
  const auto& script = std::get<mesher::ScriptMeshOptions>(structure.source);
  const double nodes = estimated_nodes(*structure.neck, *script.element);
  const std::string what = fmt::format("a mesh of about {:.3g} nodes", nodes);
  const std::string advice = "lower mesh.refine or the other divisions";
  if (3 * nodes > std::numeric_limits<std::int32_t>::max()) {
    throw InputError(what + " has more degrees of freedom than 32-bit integers can count; " +
                     advice);
  }
  require_memory(what, estimated_bytes(nodes), advice);
  return fmt::format(": about {:.3g} nodes, {}", nodes, memory_text(estimated_bytes(nodes)));
}

}  // namespace

bool mesh_command(const CommandInput& input) {
  const Study& study = input.study;
  if (!study.structure) {
    throw InputError(study.file.string() + ": expected [geometry] to mesh, found none");
  }
  const std::string required = required_text(*study.structure);
  input.folder.make();
  input.console.step("Meshing " + study.structure->file().filename().string() + required);
  mesher::MeshFile file;
  const FilesRead reads;
  file.mesh = make_mesh(study, input.console);
  file.provenance = mesh_provenance(study);
  const std::vector<InputFile> inputs = input_files(reads.files());
  file.provenance.inputs.insert(file.provenance.inputs.end(), inputs.begin(), inputs.end());
  finish_mesh(input, std::move(file), exact_volumes(*study.structure));
  return true;
}

}  // namespace flexneck::pipeline
