// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesher/exchange/nastran_cards.h"

namespace flexneck::mesher {

// Values of a card's fields, which are counted from 0 after its name.

/// Refuses a card.
/// @throws InputError "line 7: RBE2: <problem>"
[[noreturn]] void refuse_card(const NastranCard& card, const std::string& problem);

/// The integer of a field.
/// @throws InputError as refuse_card(), here and below, if the field has no such value.
std::int64_t nastran_integer(const NastranCard& card, std::size_t field);
/// The integer of a field, or the fallback if the field is empty.
std::int64_t nastran_integer_or(const NastranCard& card, std::size_t field, std::int64_t fallback);
/// The real of a field. Nastran's reals may omit the letter of the exponent: 1.5-3.
/// @param fallback value of an empty field
double nastran_number(const NastranCard& card, std::size_t field, double fallback = 0);
/// Components as digits: "123" gives 1, 2, 3.
std::array<bool, 6> nastran_components(const NastranCard& card, std::size_t field);
/// A single component, from 1 to 6.
int nastran_component(const NastranCard& card, std::size_t field);
/// Numbers from a field on, with "first THRU last"; a real after them ends the list.
/// @param is_there returns whether a number exists: missing ones within a range are left out,
/// missing ones that are written out are refused; without it all numbers are taken
std::vector<std::int64_t> nastran_list(const NastranCard& card, std::size_t field,
                                       const std::function<bool(std::int64_t)>& is_there = {});

}  // namespace flexneck::mesher
