// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/exchange/deck_connections.h"
#include "mesher/exchange/inp_cards.h"

namespace flexneck::mesher {

/// Masses and springs of an .inp: *ELEMENT of types MASS, SPRING1, SPRING2 and SPRINGA with *MASS
/// and *SPRING.
class InpPointElements {
 public:
  /// Returns whether the elements of a TYPE=, in capitals, are masses or springs.
  static bool has(const std::string& type);
  /// @return the numbers of the elements
  std::vector<std::int64_t> add(const InpCard& card, const std::string& type);
  /// @param card *MASS or *SPRING
  void read(const InpCard& card);
  /// @throws InputError for elements without *MASS or *SPRING, and for springs at nodes that have
  /// axes of their own.
  void add_to(DeckConnections& connections) const;

 private:
  void add_springs(const InpCard& card, DeckConnections& connections) const;
  void add_masses(const InpCard& card, DeckConnections& connections) const;

  struct Element {
    std::string type;
    std::string set;  ///< in capitals
    std::int64_t number;
    std::vector<std::int64_t> nodes;
  };

  std::vector<Element> elements_;
  std::vector<InpCard> properties_;  ///< *MASS and *SPRING
};

/// The component of a degree of freedom in a field.
/// @throws InputError with the line unless it is 1 to 6.
int inp_component(const InpData& line, std::size_t field);

}  // namespace flexneck::mesher
