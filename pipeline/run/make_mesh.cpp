// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/make_mesh.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/regular_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/checked_import.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/inp_import.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/process/isolated_task.h"
#include "pipeline/run/import_options.h"
#include "pipeline/run/mesh_order.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

using mesher::ForeignFormat;

/// Libraries for shapes: OpenCASCADE reads what it can of a damaged shape, and prints complaints
/// about the rest on standard output; gmsh meshes it.
constexpr const char* kShapeLibraries = "OpenCASCADE or gmsh";

bool is_deck(const StructureSection& structure) {
  return std::holds_alternative<mesher::ImportOptions>(structure.source) &&
         mesher::foreign_format_of(structure.file()) == ForeignFormat::inp;
}

/// Task for gmsh with its limits for a number of meshes.
IsolatedTask task_of(const StructureSection& structure, unsigned meshes) {
  IsolatedTask task;
  task.name = "mesh";
  task.program = library_file("flexneck-mesher");
  task.library = "gmsh";
  const auto available = static_cast<std::uint64_t>(std::min(available_memory(), 1e18));
  task.limits.memory_bytes = available;
  task.advice = "correct the script";
  task.file = structure.file();
  const std::uint64_t size = size_of_file(task.file);
  if (std::holds_alternative<mesher::ScriptMeshOptions>(structure.source)) return task;
  const ForeignFormat format = mesher::foreign_format_of(task.file);
  const bool is_shape = format == ForeignFormat::step || format == ForeignFormat::brep;
  task.advice = "if it is not damaged, write it again or in another format";
  task.limits.processor_s =
      meshes * static_cast<unsigned>(10 + (is_shape ? 10 : 1) * (size >> 20U));
  task.limits.clock_s = kClockPerProcessor * task.limits.processor_s;
  task.limits.memory_bytes = (768U << 20U) + (is_shape ? 64 : 16) * size;
  if (is_shape) {
    task.library = kShapeLibraries;
    task.limits.later_memory_bytes = available;
  }
  return task;
}

ChildLines lines_to(const Console& console) {
  return {.detail = console.detail(),
          .warning = [&](const std::string& line) { console.warning(line); },
          .chatter = console.detail()};
}

/// Joins lines up to a limited length.
Progress collector_of(std::string& text) {
  constexpr std::size_t kEnough = 300;
  return [&text](const std::string& line) {
    if (text.size() < kEnough) text += (text.empty() ? "" : "; ") + line.substr(0, kEnough);
  };
}

MeshOutcome outcome_of_deck(const Study& study, const ChildLines& lines) {
  try {
    return {mesher::checked_import(import_options_of(study), mesher::import_inp, lines.detail,
                                   lines.warning),
            {}};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

MeshOutcome outcome_of(const MeshOrder& order, std::size_t place) {
  const fs::path refusal = refusal_result(order, place);
  if (fs::exists(refusal)) return {std::nullopt, text_of_file(refusal)};
  return {mesher::read_mesh(mesh_result(order, place)).mesh, {}};
}

}  // namespace

mesher::Mesh make_mesh(const Study& study, const Console& console) {
  MeshOutcome outcome = std::move(make_meshes({&study}, console).front());
  if (!outcome.mesh) throw InputError(outcome.refusal);
  return std::move(*outcome.mesh);
}

std::vector<MeshOutcome> make_meshes(const std::vector<const Study*>& studies,
                                     const Console& console) {
  std::vector<MeshOutcome> outcomes;
  if (studies.empty()) return outcomes;
  ChildLines lines = lines_to(console);
  if (is_deck(*studies.front()->structure)) {
    for (const Study* const each : studies) outcomes.push_back(outcome_of_deck(*each, lines));
    return outcomes;
  }
  IsolatedTask task = task_of(*studies.front()->structure, static_cast<unsigned>(studies.size()));
  const TemporaryFolder folder;
  const MeshOrder order = mesh_order(folder.path(), studies);
  task.arguments = arguments_of(order);
  std::string complaints;
  if (task.library == kShapeLibraries) lines.chatter = collector_of(complaints);
  run_isolated(task, folder.path(), lines);
  if (!complaints.empty()) {
    console.warning(task.file.string() + ": OpenCASCADE reports: " + complaints +
                    "; check the volumes and sets of the mesh");
  }
  for (std::size_t k = 0; k < studies.size(); ++k) outcomes.push_back(outcome_of(order, k));
  return outcomes;
}

}  // namespace flexneck::pipeline
