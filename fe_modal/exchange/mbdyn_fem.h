// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/exchange/reduced_body.h"

namespace flexneck::fe_modal {

/// A body for the modal joint of MBDyn: its interfaces as nodes 1, 2, … with translations and
/// rotations, mass and stiffness of the modes, and the exact inertia invariants (groups 12 and 14
/// to 18). Names of interfaces and modes stand in comments. SI units. README.md tells what is lost.
/// @throws InputError if the file cannot be written.
void write_mbdyn_fem(const std::filesystem::path& path, const ModalBody& body);

/// Such a file, of ours or of another program. Without the invariants of groups 12 and 14 to 18
/// they are those of the lumped masses in group 11, if these have no rotary inertia of their own.
/// @throws InputError with the line for what is not read, missing or contradicts the rest.
ImportedModes read_mbdyn_fem(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
