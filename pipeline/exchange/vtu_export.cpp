// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/vtu_writer.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/exchange/mesh_modes.h"

namespace flexneck::pipeline {

void export_modes_vtu(const CommandInput& input, mesher::Mesh& mesh) {
  const fe_modal::ModalBody body = modes_of_mesh(input, mesh);
  std::vector<mesher::NodeVectors> shapes;
  for (std::size_t k = 0; k < body.modes.size(); ++k)
    shapes.push_back({body.modes[k].name,
                      {body.shapes[k].data(), static_cast<std::size_t>(body.shapes[k].size())}});
  mesher::VtuWriter(mesh).write(input.target, mesher::node_coordinates(mesh), shapes);
}

}  // namespace flexneck::pipeline
