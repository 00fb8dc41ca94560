// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesher/exchange/nastran_cards.h"

namespace flexneck::mesher {

// Values of a card's fields, which count from 0 behind its name.

/// @throws InputError "line 7: RBE2: <problem>"
[[noreturn]] void refuse_card(const NastranCard& card, const std::string& problem);

/// @throws InputError as refuse_card(), here and below, for what is no such value.
std::int64_t nastran_integer(const NastranCard& card, std::size_t field);
/// The fallback stands for an empty field.
std::int64_t nastran_integer_or(const NastranCard& card, std::size_t field, std::int64_t fallback);
/// Nastran's reals may leave out the letter of the exponent: 1.5-3.
/// @param fallback of an empty field
double nastran_number(const NastranCard& card, std::size_t field, double fallback = 0);
/// "123" to 1, 2, 3.
std::array<bool, 6> nastran_components(const NastranCard& card, std::size_t field);
/// One of them, from 1 to 6.
int nastran_component(const NastranCard& card, std::size_t field);
/// Numbers from a field on, with "first THRU last"; a real behind them ends the list.
/// @param is_there tells whether there is such a number: of a range those that are not there are
/// left out, one that is written out is refused; without it all are
std::vector<std::int64_t> nastran_list(const NastranCard& card, std::size_t field,
                                       const std::function<bool(std::int64_t)>& is_there = {});

}  // namespace flexneck::mesher
