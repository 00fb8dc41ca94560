// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/atb_modal_file.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/exchange/mesh_modes.h"

namespace flexneck::pipeline {

void export_atb_modes(const CommandInput& input, mesher::Mesh& mesh) {
  fe_modal::write_atb_modal_file(input.target, mesh, modes_of_mesh(input, mesh));
}

}  // namespace flexneck::pipeline
