// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/mode_table.h"

#include <fmt/core.h>

#include "fe_modal/body/basis_table.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

namespace {

/// Cells that --check adds to a row of the table.
std::vector<std::string> mesh_error_cells(const fe_modal::MeshError& estimate) {
  return {fmt::format("{:.3f}", estimate.refined_Hz),
          estimate.error < 1 ? fmt::format("{:.3f}", 100 * estimate.error)
                             : "not found in the refined mesh",
          fmt::format("{:.4f}", estimate.mac)};
}

std::vector<std::string> head(const fe_modal::ModalBody& body, bool with_shares) {
  std::vector<std::string> cells = {"mode", "kind", "Hz"};
  if (with_shares) {
    for (const char* title : {"fore-aft %", "lateral %", "twist %", "axial %"}) {
      cells.emplace_back(title);
    }
  }
  cells.emplace_back("residual");
  if (body.modes.front().mesh_error) {
    cells.emplace_back("refined Hz");
    cells.emplace_back(body.mesh_error_limits.empty() ? "mesh error %" : "indicated error %");
    cells.emplace_back("MAC");
  }
  return cells;
}

}  // namespace

std::string mode_table(const fe_modal::ModalBody& body, bool with_shares) {
  with_shares = with_shares && fe_modal::has_shares(body);
  std::vector<std::vector<std::string>> rows = {head(body, with_shares)};
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const fe_modal::ModeRecord& mode = body.modes[static_cast<std::size_t>(k)];
    std::vector<std::string> row = {mode.name, mode.kind,
                                    fmt::format("{:.3f}", body.frequencies_Hz[k])};
    if (with_shares) {
      for (const double share : mode.shares_percent) row.push_back(fmt::format("{:.2f}", share));
    }
    row.push_back(fmt::format("{:.1e}", mode.residual));
    if (mode.mesh_error) {
      for (std::string& cell : mesh_error_cells(*mode.mesh_error)) row.push_back(std::move(cell));
    }
    rows.push_back(std::move(row));
  }
  return text_table(rows, {0, 1});
}

}  // namespace flexneck::pipeline
