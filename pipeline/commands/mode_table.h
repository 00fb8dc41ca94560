// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"

namespace flexneck::pipeline {

/// A row for each mode: kind, frequency, shares of the kinetic energy where they are known,
/// residual, and what --certify has found.
std::string mode_table(const fe_modal::ModalBody& body);

}  // namespace flexneck::pipeline
