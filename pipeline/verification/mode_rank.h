// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Kinds of motion that a mode may be named after: "bending", "torsion", "axial".
std::vector<std::string> mode_kinds();

/// That of a mode: one of these, or "other".
std::string kind_of(const fe_modal::ModeRecord& mode);

/// Modes of a kind in ascending order of frequency, as positions in the body's list.
std::vector<std::size_t> modes_of_kind(const fe_modal::ModalBody& body, const std::string& kind);

}  // namespace flexneck::pipeline
