// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/verification/mode_rank.h"

namespace flexneck::pipeline {

std::vector<std::string> mode_kinds() { return {"bending", "torsion", "axial"}; }

std::string kind_of(const fe_modal::ModeRecord& mode) {
  for (const std::string& kind : mode_kinds())
    if (mode.name.find(kind) != std::string::npos) return kind;
  return "other";
}

std::vector<std::size_t> modes_of_kind(const fe_modal::ModalBody& body, const std::string& kind) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < body.modes.size(); ++k)
    if (kind_of(body.modes[k]) == kind) found.push_back(k);
  return found;
}

}  // namespace flexneck::pipeline
