// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/system/modal_options.h"
#include "fe_modal/system/model.h"

namespace flexneck::fe_modal {

/// Checks the options for a mesh.
/// @throws InputError for the first option that does not fit the mesh or the other options.
void check_options(const mesher::Mesh& mesh, const ModalOptions& options);
/// Checks the options of a model whose mesh mesher::check() accepts.
void check_options(const Model& model);

/// Refuses a body with rigid motions.
/// @param who needs the supports: "a static step"
/// @throws InputError with the remaining rigid motions, if there are any.
void require_supports(const RigidMotions& rigid, const std::string& who);

}  // namespace flexneck::fe_modal
