// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/modes_xdmf.h"

#include <string>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "mesher/exchange/xdmf_document.h"

namespace flexneck::fe_modal {
namespace {

constexpr FileFormat kViewFormat{"flexneck modes view", 2, "flexneck modes"};

/// Writes a dataset for each mode: two of the three XDMF readers of ParaView do not find parts of a
/// larger dataset.
std::vector<mesher::XdmfItem> write_shapes(const std::filesystem::path& path,
                                           const ModalBody& body) {
  Hdf5Writer file(path, kViewFormat);
  std::vector<mesher::XdmfItem> items;
  for (std::size_t k = 0; k < body.shapes.size(); ++k) {
    const Eigen::Matrix3Xd& shape = body.shapes[k];
    const Shape extents = {static_cast<std::size_t>(shape.cols()), 3};
    items.push_back({path, "/shapes/" + std::to_string(k), extents, true});
    file.write(items.back().dataset, {shape.data(), static_cast<std::size_t>(shape.size())},
               extents, "kg^(-1/2)");
  }
  file.commit(Durability::none);
  return items;
}

}  // namespace

void write_modes_xdmf(const std::filesystem::path& modes_file,
                      const std::filesystem::path& mesh_file, const mesher::Mesh& mesh,
                      const ModalBody& body) {
  const std::vector<mesher::XdmfItem> shapes = write_shapes(mesher::view_file(modes_file), body);
  std::filesystem::path path = modes_file;
  mesher::XdmfDocument xdmf(path.replace_extension(".xdmf"), "modes");
  const mesher::XdmfItem positions{modes_file, "/nodes", {mesh.nodes.size(), 3}, true};
  for (const mesher::ElementBlock& block : mesh.blocks) {
    xdmf.begin_grid(mesher::grid_name(mesh, block), block.kind,
                    mesher::view_connectivity(mesh_file, block), positions);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      xdmf.node_vector(body.modes[k].name, shapes[k]);
    }
    xdmf.end_grid();
  }
  xdmf.commit();
}

}  // namespace flexneck::fe_modal
