// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/evaluation/make_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include <fmt/core.h>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/regular_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/import_check.h"
#include "mesher/exchange/mesh_import.h"
#include "mesher/gmsh/script_mesher.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/document/shipped_files.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

using mesher::ForeignFormat;

/// The one reads what it can of a damaged shape, and complains of the rest on standard output; the
/// other meshes it.
constexpr const char* kShapeLibraries = "OpenCASCADE or gmsh";

/// What is called with a number of nodes once a shape is read; see ImportOptions.
using WhenRead = std::function<void(double nodes)>;

mesher::Mesh mesh_here(const Study& study, const ChildLines& lines, const WhenRead& when_read) {
  const auto& source = study.structure->source;
  if (const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&source)) {
    mesher::Mesh mesh = mesher::mesh_script(*script, lines.detail, lines.warning);
    try {  // a script may leave bodies apart, or lay them over one another
      mesher::check_import(mesh, !script->slits.empty());
    } catch (const InputError& error) {
      throw InputError(script->script.string() + ": " + error.what());
    }
    return mesh;
  }
  auto options = std::get<mesher::ImportOptions>(source);
  options.is_reduced = study.modes.formulation == fe_modal::Formulation::reduced;
  options.when_read = when_read;
  return mesher::import_mesh(options, lines.detail, lines.warning);
}

bool is_shipped(const fs::path& script) {
  std::error_code none;
  return fs::equivalent(script, shipped_file("geometry/neck.geo"), none);
}

/// What a child meshes, and may take for it; none for what this process may mesh itself.
std::optional<IsolatedTask> task_of(const Study& study) {
  IsolatedTask task;
  task.name = "mesh";
  task.library = "gmsh";
  const auto available = static_cast<std::uint64_t>(std::min(available_memory(), 1e18));
  task.limits.memory_bytes = available;
  task.advice = "correct the script";
  task.file = study.structure->file();
  const std::uint64_t size = size_of_file(task.file);
  if (std::holds_alternative<mesher::ScriptMeshOptions>(study.structure->source))
    return is_shipped(task.file) ? std::nullopt : std::optional(task);
  const ForeignFormat format = mesher::foreign_format_of(task.file);
  if (format == ForeignFormat::inp) return std::nullopt;  // read by us, not by gmsh
  const bool is_shape = format == ForeignFormat::step || format == ForeignFormat::brep;
  task.advice = "if it is not damaged, write it anew or in another format";
  task.limits.processor_s = static_cast<unsigned>(10 + (is_shape ? 10 : 1) * (size >> 20U));
  task.limits.clock_s = kClockPerProcessor * task.limits.processor_s;
  task.limits.memory_bytes = (768U << 20U) + (is_shape ? 64 : 16) * size;
  if (is_shape) {
    task.library = kShapeLibraries;
    task.limits.later_memory_bytes = available;
  }
  return task;
}

/// What gmsh may take to mesh a shape that is read: ten times as long as it took for bars with
/// holes, since over some damaged shapes it does not end.
void limit_meshing(const fs::path& shape, double nodes) {
  constexpr double kBase_s = 8;
  constexpr double kPerMegabyte_s = 60;  // of small faces and edges, which have nodes of their own
  constexpr double kPerNode_s = 4e-4;
  constexpr double kBytesPerNode = 800;
  if (!std::isfinite(nodes)) {
    throw InputError("its volumes, surfaces or curves have no finite size");
  }
  require_memory(fmt::format("a mesh of about {:.3g} nodes", nodes), kBytesPerNode * nodes,
                 "enlarge mesh.size, or correct the shape's unit");
  const double megabytes = static_cast<double>(size_of_file(shape)) / (1U << 20U);
  limit_what_follows(
      static_cast<unsigned>(std::ceil(kBase_s + kPerMegabyte_s * megabytes + kPerNode_s * nodes)));
}

ChildLines lines_to(const Console& console) {
  return {.detail = console.detail(),
          .warning = [&](const std::string& line) { console.warning(line); },
          .chatter = console.detail()};
}

/// Joins lines as far as they fit one.
Progress collector_of(std::string& text) {
  constexpr std::size_t kEnough = 300;
  return [&text](const std::string& line) {
    if (text.size() < kEnough) text += (text.empty() ? "" : "; ") + line.substr(0, kEnough);
  };
}

}  // namespace

mesher::Mesh make_mesh(const Study& study, const Console& console) {
  ChildLines lines = lines_to(console);
  std::optional<IsolatedTask> task = task_of(study);
  if (!task) return mesh_here(study, lines, {});
  const TemporaryFolder folder;
  const fs::path result = folder / "mesh.h5";
  task->arguments = {result.string(), study.file.string()};
  task->arguments.insert(task->arguments.end(), study.settings.begin(), study.settings.end());
  std::string complaints;
  if (task->library == kShapeLibraries) lines.chatter = collector_of(complaints);
  run_isolated(*task, folder.path(), lines);
  if (!complaints.empty()) {
    console.warning(task->file.string() + ": OpenCASCADE complains: " + complaints +
                    "; compare volumes and sets with what they should be");
  }
  return mesher::read_mesh(result).mesh;
}

void mesh_task(const std::vector<std::string>& arguments, const ChildLines& lines) {
  const Study study = read_study(arguments.at(1), {arguments.begin() + 2, arguments.end()});
  const auto when_read = [&](double nodes) { limit_meshing(study.structure->file(), nodes); };
  mesher::write_mesh(arguments.front(),
                     {.mesh = mesh_here(study, lines, when_read), .provenance = {}});
}

}  // namespace flexneck::pipeline
