// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/exchange/reduced_body.h"

namespace flexneck::fe_modal {

/// Writes a body for the modal joint of MBDyn: its interfaces as nodes 1, 2, … with translations
/// and rotations, mass and stiffness of the modes, and the exact inertia invariants (groups 12 and
/// 14 to 18). Names of interfaces and modes stand in comments. SI units. guides/exchange.md
/// describes the losses.
/// @throws InputError if the file cannot be written.
void write_mbdyn_fem(const std::filesystem::path& path, const ModalBody& body);

/// Reads such a file, of this or of another program. Without groups 12 and 14 to 18 the invariants
/// are those of the lumped masses in group 11, if these have no rotary inertia of their own.
/// @throws InputError with the line for data that is not supported, missing or in contradiction to
/// the rest.
ImportedModes read_mbdyn_fem(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
