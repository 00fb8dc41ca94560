// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/atb_modal_file.h"
#include "geometry/foundation/error.h"
#include "pipeline/commands/exports/export_formats.h"
#include "pipeline/isolation/result_files.h"

namespace flexneck::pipeline {

void export_atb_modes(const CommandInput& input, mesher::Mesh& mesh) {
  const fe_modal::ModalBodyFile modes = read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study,
                      modes_provenance(input.study).parameters, "flexneck modes");
  if (modes.body.nodes_m.cols() != static_cast<Eigen::Index>(mesh.nodes.size())) {
    throw InputError(input.folder.modes().string() + ": belongs to another mesh than " +
                     input.folder.mesh().string() + "; make it again with 'flexneck modes'");
  }
  fe_modal::write_atb_modal_file(input.target, mesh, modes.body);
}

}  // namespace flexneck::pipeline
