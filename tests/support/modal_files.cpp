// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/modal_files.h"

namespace flexneck::testing {

void write_beam_modes(const std::filesystem::path& path, const Beam& beam, const std::string& root,
                      const std::string& tip) {
  fe_modal::ModalBodyFile file;
  file.body = make_beam_body(beam);
  file.body.interfaces[0].name = root;
  file.body.interfaces[1].name = tip;
  file.body.geometric_stiffness->interfaces[0].name = tip;
  file.provenance.program = "test";
  fe_modal::write_modal_body(path, file);
}

}  // namespace flexneck::testing
