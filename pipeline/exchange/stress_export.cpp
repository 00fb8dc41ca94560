// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/static_xdmf.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "mesher/exchange/vtu_writer.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

void export_stress_vtu(const FileInput& input) {
  const std::filesystem::path& file = input.files.front();
  if (std::filesystem::exists(file) &&
      format_of(ReadableFile(file).path()) != fe_modal::kStaticSolutionFormat.name)
    throw InputError(input.target.string() +
                     ": expected the extension .mme, .pvd or .csv for the run " + file.string() +
                     ", which contains no stresses");
  const fe_modal::StaticSolution solution = read_static_solution(file).solution;
  const ResultsFolder folder(file.parent_path());
  const mesher::Mesh mesh = read_mesh(folder.mesh()).mesh;
  if (solution.nodes_m.cols() != static_cast<Eigen::Index>(mesh.nodes.size()))
    throw InputError(file.string() + ": belongs to another mesh than " + folder.mesh().string() +
                     "; make it again with 'flexneck stress'");
  const auto numbers = [](const Eigen::Matrix3Xd& columns) {
    return std::span(columns.data(), static_cast<std::size_t>(columns.size()));
  };
  std::vector<mesher::NodeVectors> fields = {
      {"displacement [m]", numbers(solution.displacements_m)},
      {"reaction [N]", numbers(solution.reactions_N)}};
  const std::vector<fe_modal::SpreadStresses> stresses = fe_modal::spread_stresses(solution);
  for (const fe_modal::SpreadStresses& each : stresses) {
    fields.push_back({"stress of " + each.material + " [Pa]", each.tensor_Pa, 9});
    fields.push_back({"von Mises stress of " + each.material + " [Pa]", each.von_mises_Pa, 1});
  }
  mesher::VtuWriter(mesh).write(input.target, mesher::node_coordinates(mesh), fields);
}

}  // namespace flexneck::pipeline
