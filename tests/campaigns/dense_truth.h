// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "mesher/mesh/mesh.h"
#include "tests/campaigns/campaign.h"

namespace flexneck::campaigns {

/// Compares the lowest eight modes of a mesh with the dense eigenvalues, in the null space of all
/// equations, of the intended mesh: usually the same one, or the one from which a file was written.
/// @param size_m  size of the body
/// @return what is wrong; nothing if the modes are right, or refused for a valid reason
std::optional<std::string> compare_modes(Case& drawn, const mesher::Mesh& given,
                                         const mesher::Mesh& meant, double size_m);

}  // namespace flexneck::campaigns
