// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/msh_writer.h"
#include "pipeline/exchange/export_formats.h"

namespace flexneck::pipeline {

void export_msh(const CommandInput& input, mesher::Mesh& mesh) {
  mesher::write_msh(input.target, mesh,
                    input.is_binary ? mesher::MshEncoding::binary : mesher::MshEncoding::text);
  if (const std::string text = mesh.connections.text(); !text.empty())
    input.console.warning(input.target.string() + ": not carried over: " + text);
}

}  // namespace flexneck::pipeline
