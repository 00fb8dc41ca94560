// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/system/modal_options.h"

namespace flexneck::fe_modal {

/// @throws InputError for the first option that does not fit the mesh or the other options.
void check_options(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
