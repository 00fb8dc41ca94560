// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Kinds of motion by which modes are named: "bending", "torsion", "axial".
std::vector<std::string> mode_kinds();

/// Kind of a mode: one of these, or "other".
std::string kind_of(const fe_modal::ModeRecord& mode);

/// Indices of the modes of a kind in the body's list, by ascending frequency.
std::vector<std::size_t> modes_of_kind(const fe_modal::ModalBody& body, const std::string& kind);

}  // namespace flexneck::pipeline
