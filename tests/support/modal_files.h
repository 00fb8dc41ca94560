// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "fe_modal/body/modal_body_file.h"
#include "tests/support/beam_body.h"

namespace flexneck::testing {

/// Writes a beam in the format of `flexneck modes`: its bending modes have the names of the neck's.
void write_beam_modes(const std::filesystem::path& path, const Beam& beam = {},
                      const std::string& root = "base", const std::string& tip = "top");

}  // namespace flexneck::testing
