// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// Table with a row for each mode: kind, frequency, residual, and the results of --check.
/// @param with_shares adds the fractions of the kinetic energy, where they are known
std::string mode_table(const fe_modal::ModalBody& body, bool with_shares);

}  // namespace flexneck::pipeline
