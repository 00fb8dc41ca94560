// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/system/modal_options.h"
#include "fe_modal/system/modal_system.h"

namespace flexneck::fe_modal {

/// K and M of a mesh, assembled where the options want them.
/// @throws what assemble() throws.
std::unique_ptr<ModalSystem> make_system(const mesher::Mesh& mesh, const DofMap& dof_map,
                                         const ModalOptions& options);

}  // namespace flexneck::fe_modal
