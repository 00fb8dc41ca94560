// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// A row for each mode: kind, frequency, residual, and what --check has found.
/// @param with_shares of the kinetic energy too, where they are known
std::string mode_table(const fe_modal::ModalBody& body, bool with_shares);

}  // namespace flexneck::pipeline
