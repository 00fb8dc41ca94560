// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/mesh_modes.h"

#include "geometry/foundation/error.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

fe_modal::ModalBody modes_of_mesh(const CommandInput& input, const mesher::Mesh& mesh) {
  fe_modal::ModalBodyFile modes = read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study,
                      modes_provenance(input.study).parameters, "flexneck modes");
  require_modes_of(mesh, modes.body, input.folder.modes());
  return std::move(modes.body);
}

void require_modes_of(const mesher::Mesh& mesh, const fe_modal::ModalBody& body,
                      const std::filesystem::path& modes_file) {
  if (body.nodes_m.cols() == static_cast<Eigen::Index>(mesh.nodes.size())) return;
  throw InputError(
      modes_file.string() +
      ": belongs to another mesh than mesh.h5 in this folder; make it again with 'flexneck modes'");
}

}  // namespace flexneck::pipeline
