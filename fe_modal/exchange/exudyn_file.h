// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// Writes a body as Exudyn's ObjectFFRFreducedOrderInterface loads it from HDF5, with the exact
/// inertia invariants, SI units. Its nodes have translations only, so that each interface is
/// represented, at the end of the list in the body's order, by four nodes without mass that move
/// rigidly with it to the first order: a marker on all four with equal weights is the interface.
/// guides/exchange.md describes the losses.
/// @throws InputError if the file cannot be written.
void write_exudyn(const std::filesystem::path& path, const ModalBody& body);

}  // namespace flexneck::fe_modal
