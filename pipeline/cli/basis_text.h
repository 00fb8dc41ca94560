// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Tables by which the number of modes is judged: the inertia, and the static compliance of each
/// interface, that the modes represent.
std::string basis_text(const fe_modal::ModalBody& body);

/// Table of the frequencies of each attached body.
/// @param with_counts appends a table of the frequencies that fewer modes would give
std::string loaded_text(const fe_modal::ModalBody& body, bool with_counts);

}  // namespace flexneck::pipeline
