// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesher/exchange/deck_connections.h"
#include "mesher/exchange/inp_model.h"
#include "mesher/exchange/inp_point_elements.h"

namespace flexneck::mesher {

/// Reads the connections of an .inp: supports (*BOUNDARY), equations (*EQUATION, *MPC of types PIN,
/// TIE, LINK and BEAM), rigid bodies (*RIGID BODY), masses and springs (*ELEMENT of types MASS,
/// SPRING1, SPRING2 and SPRINGA with *MASS and *SPRING) and axes of nodes (*TRANSFORM).
class InpConnectionReader {
 public:
  /// Reads elements of a type for which InpPointElements::has() is true.
  /// @return their numbers
  std::vector<std::int64_t> elements(const InpCard& card, const std::string& type) {
    return point_elements_.add(card, type);
  }

  /// @param card one of those above, except *ELEMENT
  void read(const InpCard& card, const InpModel& model);

  /// Nodes that supports and rigid bodies name by number.
  const std::vector<std::int64_t>& supported_by_number() const { return supported_by_number_; }
  /// @throws InputError for elements without *MASS or *SPRING, and for connections that *TRANSFORM
  /// makes ambiguous.
  DeckConnections finish(const InpModel& model);

 private:
  using Handler = void (InpConnectionReader::*)(const InpCard&, const InpModel&);
  static const std::map<std::string, Handler>& handlers();

  void boundary(const InpCard& card, const InpModel& model);
  void equation(const InpCard& card, const InpModel& model);
  void mpc(const InpCard& card, const InpModel& model);
  void rigid_body(const InpCard& card, const InpModel& model);
  void transform(const InpCard& card, const InpModel& model);
  void point_property(const InpCard& card, const InpModel& /*model*/) {
    point_elements_.read(card);
  }

  DeckConnections connections_;
  InpPointElements point_elements_;
  std::map<std::int64_t, std::set<int>> supports_;
  std::vector<std::int64_t> supported_by_number_;
};

}  // namespace flexneck::mesher
