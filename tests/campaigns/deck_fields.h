// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/campaigns/deck.h"

namespace flexneck::campaigns {

/// A number by a format of printf.
std::string printed(const char* format, double value);
/// Text of a coordinate with at most three decimals.
std::string coordinate(Case& drawn, double value, bool is_short);
/// A value of four digits: 1.234E+03.
std::string value_text(double value);
/// The text in capitals, in small letters, or unchanged.
std::string cased(Case& drawn, std::string text);

/// Types and node orders of an element kind in the formats: corners by their digit, midside nodes
/// by their two corners.
struct Orders {
  const char *abaqus_type, *abaqus, *nastran_type, *nastran, *unv_type, *unv, *gmsh_type, *gmsh;
};
const Orders& orders_of(mesher::ElementKind kind);

std::vector<std::string> numbers_of(const Deck& deck, const std::vector<std::size_t>& nodes);
/// Numbers of an element's nodes in an order of Orders.
std::vector<std::string> element_fields(const Deck& deck, std::size_t element,
                                        const std::string& order);
/// Random order in which a deck writes its items.
std::vector<std::size_t> shuffled(Case& drawn, std::size_t count);
void save(const std::filesystem::path& file, const std::string& text);

template <class Choices>
const auto& one_of(Case& drawn, const Choices& choices) {
  return choices[static_cast<std::size_t>(drawn.whole(0, static_cast<int>(choices.size()) - 1))];
}

}  // namespace flexneck::campaigns
