// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Whether there are modes enough: tables of the inertia and of each interface's static compliance
/// that the modes hold, and for each attached body its frequencies and those that fewer modes would
/// give.
std::string basis_text(const fe_modal::ModalBody& body);

}  // namespace flexneck::pipeline
