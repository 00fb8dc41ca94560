// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Whether there are modes enough: tables of the inertia and of each interface's static compliance
/// that the modes hold.
std::string basis_text(const fe_modal::ModalBody& body);

/// For each attached body its frequencies.
/// @param with_counts and a table of those that fewer modes would give
std::string loaded_text(const fe_modal::ModalBody& body, bool with_counts);

}  // namespace flexneck::pipeline
