// SPDX-License-Identifier: GPL-3.0-or-later
// Target: reduced bodies from other programs, MBDyn's .fem or SID_FEM. The first byte selects the
// format.
#include "fe_modal/body/modal_body_check.h"
#include "fe_modal/exchange/mbdyn_fem.h"
#include "fe_modal/exchange/sid_fem.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  if (size == 0) return 0;
  const bool is_sid = (data[0] & 1) != 0;
  const std::filesystem::path path =
      folder.with(is_sid ? "body.SID_FEM" : "body.fem", fuzz::text_of(data + 1, size - 1));
  return fuzz::try_reader([&] {
    const fe_modal::ImportedModes found =
        is_sid ? fe_modal::read_sid_fem(path) : fe_modal::read_mbdyn_fem(path);
    fe_modal::check_modal_body(found.body);
    fuzz::require(found.body.invariants.S2.allFinite() && found.body.nodes_m.allFinite(),
                  "a body is finite");
  });
}
