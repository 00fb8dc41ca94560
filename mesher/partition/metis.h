// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>

#include <metis.h>

namespace flexneck::mesher {

using MetisOptions = std::array<idx_t, METIS_NOPTIONS>;

/// METIS's defaults with indices from 0 and a fixed seed: equal input gives equal output.
MetisOptions metis_options();

/// Checks the status of METIS.
/// @throws ComputationError naming the operation `doing`, unless the status is METIS_OK.
void require_metis(int status, const std::string& doing);

struct MetisFree {
  void operator()(idx_t* memory) const { METIS_Free(memory); }
};
/// An array that METIS has allocated.
using MetisArray = std::unique_ptr<idx_t[], MetisFree>;

}  // namespace flexneck::mesher
