// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "fe_modal/body/modal_body_file.h"
#include "tests/support/beam_body.h"

namespace flexneck::testing {

/// A beam as `flexneck modes` would leave it: its bending modes have the names of the neck's.
inline void write_beam_modes(const std::filesystem::path& path, const Beam& beam = {},
                             const std::string& root = "base", const std::string& tip = "top") {
  fe_modal::ModalBodyFile file;
  file.body = make_beam_body(beam);
  file.body.interfaces[0].name = root;
  file.body.interfaces[1].name = tip;
  file.body.geometric_stiffness->interfaces[0].name = tip;
  file.provenance.program = "test";
  fe_modal::write_modal_body(path, file);
}

}  // namespace flexneck::testing
