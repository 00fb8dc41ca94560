// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/static_xdmf.h"

#include <limits>

#include "geometry/foundation/hdf5_file.h"
#include "mesher/exchange/xdmf_document.h"

namespace flexneck::fe_modal {
namespace {

constexpr FileFormat kStressViewFormat{"flexneck stress view", 1, "flexneck stress"};

/// Datasets of the stresses of a material.
struct StressItems {
  mesher::XdmfItem tensor, von_mises;
};

/// Writes the stresses, by the mesh's materials.
std::vector<StressItems> write_stresses(const std::filesystem::path& path, const mesher::Mesh& mesh,
                                        const StaticSolution& solution) {
  Hdf5Writer file(path, kStressViewFormat);
  std::vector<StressItems> items(mesh.materials.size());
  for (const SpreadStresses& each : spread_stresses(solution)) {
    const StressItems written{{path, "/stress/" + each.material, {mesh.nodes.size(), 9}, true},
                              {path, "/von_mises/" + each.material, {mesh.nodes.size(), 1}, true}};
    file.write(written.tensor.dataset, each.tensor_Pa, written.tensor.shape, "Pa");
    file.write(written.von_mises.dataset, each.von_mises_Pa, written.von_mises.shape, "Pa");
    for (std::size_t m = 0; m < items.size(); ++m) {
      if (mesh.materials[m].name == each.material) items[m] = written;
    }
  }
  file.commit(Durability::none);
  return items;
}

}  // namespace

std::vector<SpreadStresses> spread_stresses(const StaticSolution& solution) {
  const auto n = static_cast<std::size_t>(solution.nodes_m.cols());
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<SpreadStresses> result;
  for (const NodalStresses& each : solution.at_nodes) {
    SpreadStresses spread{each.material, std::vector<double>(9 * n, kNone),
                          std::vector<double>(n, kNone)};
    for (std::size_t k = 0; k < each.nodes.size(); ++k) {
      const Stress stress = each.stress_Pa.col(static_cast<Eigen::Index>(k));
      const auto node = static_cast<std::size_t>(each.nodes[k]);
      Eigen::Map<Eigen::Matrix3d>(&spread.tensor_Pa[9 * node]) = tensor_of(stress);
      spread.von_mises_Pa[node] = von_mises_Pa(stress);
    }
    result.push_back(std::move(spread));
  }
  return result;
}

void write_static_xdmf(const std::filesystem::path& path, const std::filesystem::path& mesh_file,
                       const mesher::Mesh& mesh, const StaticSolution& solution) {
  const std::vector<StressItems> stresses = write_stresses(mesher::view_file(path), mesh, solution);
  std::filesystem::path document = path;
  mesher::XdmfDocument xdmf(document.replace_extension(".xdmf"), "static step");
  const Shape vectors = {mesh.nodes.size(), 3};
  for (const mesher::ElementBlock& block : mesh.blocks) {
    xdmf.begin_grid(mesher::grid_name(mesh, block), block.kind,
                    mesher::view_connectivity(mesh_file, block), {path, "/nodes", vectors, true});
    xdmf.node_vector("displacement [m]", {path, "/displacements", vectors, true});
    xdmf.node_vector("reaction [N]", {path, "/reactions", vectors, true});
    xdmf.node_tensor("stress [Pa]", stresses.at(block.material).tensor);
    xdmf.node_scalar("von Mises stress [Pa]", stresses.at(block.material).von_mises);
    xdmf.end_grid();
  }
  xdmf.commit();
}

}  // namespace flexneck::fe_modal
