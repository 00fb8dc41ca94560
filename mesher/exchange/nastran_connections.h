// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "mesher/exchange/deck_connections.h"
#include "mesher/exchange/left_out.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/nastran_case_control.h"

namespace flexneck::mesher {

/// Returns whether read_nastran_connections() reads a card, other than GRID and coordinate systems.
bool is_nastran_connection(std::string_view name);

/// Reads RBE2, MPC, SPC, SPC1, the supports of GRIDs, CONM2, CELAS1 with PELAS, and CELAS2, in the
/// axes of CORD1R, CORD1C, CORD2R and CORD2C. Sets of SPC and MPC are those that the case control
/// selects; without a case control, the only ones.
/// @param positions of all GRIDs
/// @param left_out gets the cards of sets that are not selected
/// @throws InputError with the line for fields that are not numbers, nodes that do not exist,
/// coordinate systems that do not exist or are not of these kinds, displacements that are not zero;
/// for several sets of which none is selected.
DeckConnections read_nastran_connections(
    const std::vector<NastranCard>& cards, const NastranCaseControl& control,
    const std::map<std::int64_t, std::array<double, 3>>& positions, LeftOut& left_out);

}  // namespace flexneck::mesher
