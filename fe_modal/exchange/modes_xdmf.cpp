// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/modes_xdmf.h"

#include "mesher/exchange/xdmf_document.h"

namespace flexneck::fe_modal {

void write_modes_xdmf(const std::filesystem::path& modes_file,
                      const std::filesystem::path& mesh_file, const mesher::Mesh& mesh,
                      const ModalBody& body) {
  std::filesystem::path path = modes_file;
  mesher::XdmfDocument xdmf(path.replace_extension(".xdmf"), "modes");
  const std::size_t nodes = mesh.nodes.size();
  const mesher::XdmfItem positions{modes_file, "/nodes", {nodes, 3}, true};
  mesher::XdmfItem shape{modes_file, "/shapes", {body.shapes.size(), nodes, 3}, true};
  for (const mesher::ElementBlock& block : mesh.blocks) {
    xdmf.begin_grid(mesher::grid_name(mesh, block), block.kind,
                    mesher::view_connectivity(mesh_file, block), positions);
    for (std::size_t k = 0; k < body.modes.size(); ++k) {
      shape.place = k;
      xdmf.node_vector(body.modes[k].name, shape);
    }
    xdmf.end_grid();
  }
  xdmf.commit();
}

}  // namespace flexneck::fe_modal
