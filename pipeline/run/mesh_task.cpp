// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/mesh_task.h"

#include <cmath>
#include <filesystem>
#include <variant>

#include <fmt/core.h>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/regular_file.h"
#include "mesher/exchange/import_check.h"
#include "mesher/gmsh/mesh_import.h"
#include "mesher/gmsh/script_mesher.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/run/import_options.h"
#include "pipeline/run/mesh_order.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

mesher::Mesh mesh_of_script(const mesher::ScriptMeshOptions& script, const ChildLines& lines) {
  mesher::Mesh mesh = mesher::mesh_script(script, lines.detail, lines.warning);
  try {  // a script may leave bodies unconnected or overlapping
    mesher::check_import(mesh, !script.slits.empty());
  } catch (const InputError& error) {
    throw InputError(script.script.string() + ": " + error.what());
  }
  return mesh;
}

/// Limits the meshing of a shape that has been read to ten times the time for bars with holes,
/// since for some damaged shapes it does not end.
void limit_meshing(const fs::path& shape, double nodes) {
  constexpr double kBase_s = 8;
  constexpr double kPerMegabyte_s = 60;  // small faces and edges have nodes of their own
  constexpr double kPerNode_s = 4e-4;
  constexpr double kBytesPerNode = 800;
  if (!std::isfinite(nodes)) {
    throw InputError("expected volumes, surfaces and curves of finite size");
  }
  require_memory(fmt::format("a mesh of about {:.3g} nodes", nodes), kBytesPerNode * nodes,
                 "increase mesh.size, or correct the unit of the shape");
  const double megabytes = static_cast<double>(size_of_file(shape)) / (1U << 20U);
  limit_what_follows(
      static_cast<unsigned>(std::ceil(kBase_s + kPerMegabyte_s * megabytes + kPerNode_s * nodes)));
}

mesher::Mesh mesh_of_file(const Study& study, const ChildLines& lines) {
  mesher::ImportOptions options = import_options_of(study);
  options.when_read = [&](double nodes) { limit_meshing(options.file, nodes); };
  return mesher::import_mesh(options, lines.detail, lines.warning);
}

mesher::Mesh mesh_of(const Study& study, const ChildLines& lines) {
  const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&study.structure->source);
  return script != nullptr ? mesh_of_script(*script, lines) : mesh_of_file(study, lines);
}

/// Reads a study without recording its files, which the parent has recorded.
Study study_of(const StudyChoice& choice) {
  FilesRead reads;
  Study study = read_study(choice.study, choice.settings);
  reads.forget();
  return study;
}

}  // namespace

void mesh_task(const std::vector<std::string>& arguments, const ChildLines& lines) {
  const MeshOrder order = order_from(arguments);
  for (std::size_t place = 0; place < order.studies.size(); ++place) {
    const StudyChoice& choice = order.studies[place];
    const Study study = study_of(choice);
    try {
      mesher::write_mesh(mesh_result(order, place),
                         {.mesh = mesh_of(study, lines), .provenance = {}});
    } catch (const InputError& error) {
      write_text(refusal_result(order, place), error.what());
    }
  }
}

}  // namespace flexneck::pipeline
