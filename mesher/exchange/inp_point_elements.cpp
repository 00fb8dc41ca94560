// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_point_elements.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

/// Types of point elements with their numbers of nodes.
constexpr std::array<std::pair<const char*, std::size_t>, 4> kPointTypes = {
    {{"MASS", 1}, {"SPRING1", 1}, {"SPRING2", 2}, {"SPRINGA", 2}}};

}  // namespace

int inp_component(const InpData& line, std::size_t field) {
  const std::int64_t component = inp_integer(line, field);
  if (component < 1 || component > 6) {
    throw InputError(line.place.text() + "expected a degree of freedom from 1 to 6, found " +
                     std::to_string(component));
  }
  return static_cast<int>(component);
}

bool InpPointElements::has(const std::string& type) {
  return std::any_of(kPointTypes.begin(), kPointTypes.end(),
                     [&](const auto& each) { return type == each.first; });
}

std::vector<std::int64_t> InpPointElements::add(const InpCard& card, const std::string& type) {
  const auto* const row = std::find_if(kPointTypes.begin(), kPointTypes.end(),
                                       [&](const auto& each) { return type == each.first; });
  std::vector<std::int64_t> numbers;
  for (const InpData& line : card.data) {
    Element element{type, upper_case(card.parameter("ELSET")), inp_integer(line, 0), {}};
    for (std::size_t f = 1; f <= row->second; ++f) element.nodes.push_back(inp_integer(line, f));
    numbers.push_back(element.number);
    elements_.push_back(std::move(element));
  }
  return numbers;
}

void InpPointElements::read(const InpCard& card) {
  static_cast<void>(card.parameter("ELSET"));
  properties_.push_back(card);
}

void InpPointElements::add_masses(const InpCard& card, DeckConnections& connections) const {
  if (card.data.size() != 1) card.refuse("expected one line of data, the mass");
  for (const Element& element : elements_) {
    if (element.set != upper_case(card.parameter("ELSET")) || element.type != "MASS") continue;
    connections.masses.push_back({"MASS element " + std::to_string(element.number),
                                  element.nodes[0],
                                  inp_number(card.data.front(), 0),
                                  {},
                                  {}});
  }
}

void InpPointElements::add_springs(const InpCard& card, DeckConnections& connections) const {
  for (const Element& element : elements_) {
    if (element.set != upper_case(card.parameter("ELSET")) || element.type == "MASS") continue;
    DeckSpring spring;
    spring.name = element.type + " element " + std::to_string(element.number);
    spring.is_along_nodes = element.type == "SPRINGA";
    const std::size_t lines = spring.is_along_nodes ? 1 : 2;  // without its blank line, which is
                                                              // not stored
    if (card.data.size() != lines) {
      card.refuse("expected a line with the degrees of freedom and a line with the stiffness");
    }
    if (card.data.back().fields.size() > 1 && inp_number(card.data.back(), 1) != 0) {
      card.refuse("only a single stiffness is supported");
    }
    spring.stiffness = inp_number(card.data.back(), 0);
    for (std::size_t k = 0; k < element.nodes.size(); ++k) {
      const int component = spring.is_along_nodes ? 1 : inp_component(card.data.front(), k);
      if (connections.axes.count(element.nodes[k]) > 0) {
        card.refuse(spring.name + " is at a node with a *TRANSFORM, which is not supported");
      }
      spring.terms.push_back({element.nodes[k], component, k == 0 ? 1.0 : -1.0});
    }
    connections.springs.push_back(std::move(spring));
  }
}

void InpPointElements::add_to(DeckConnections& connections) const {
  std::set<std::string> given;
  for (const InpCard& card : properties_) {
    const std::string set = upper_case(card.parameter("ELSET"));
    if (std::none_of(elements_.begin(), elements_.end(), [&](const Element& element) {
          return element.set == set && (element.type == "MASS") == (card.keyword == "MASS");
        })) {
      card.refuse("there are no elements of this type in ELSET '" + card.parameter("ELSET") +
                  "'; add ELSET= to their *ELEMENT");
    }
    if (!given.insert(card.keyword + set).second) {
      card.refuse("ELSET '" + card.parameter("ELSET") + "' already has this property");
    }
    card.keyword == "MASS" ? add_masses(card, connections) : add_springs(card, connections);
  }
  for (const Element& element : elements_) {
    const std::string keyword = element.type == "MASS" ? "MASS" : "SPRING";
    if (given.count(keyword + element.set) > 0) continue;
    throw InputError(element.type + " element " + std::to_string(element.number) + " has no *" +
                     keyword + " for its ELSET");
  }
}

}  // namespace flexneck::mesher
