// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/deck_sites.h"

#include <array>
#include <vector>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {

namespace {

/// Returns whether exactly one of a node's directions x and y is fixed, of its translations or of
/// its rotations.
bool holds_one(const std::array<bool, 6>& components) {
  return components[0] != components[1] || components[3] != components[4];
}

/// Nodes where radial and tangential directions differ: supports fix only one of them, or an
/// equation or a spring acts on one.
std::set<std::int64_t> nodes_with_radial_directions(const DeckConnections& deck) {
  std::map<std::int64_t, std::array<bool, 6>> held;
  for (const DeckSupport& support : deck.supports) {
    std::array<bool, 6>& all = held[support.node];
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = all[c] || support.components[c];
  }
  std::set<std::int64_t> nodes;
  for (const auto& [node, components] : held) {
    if (holds_one(components)) nodes.insert(node);
  }
  const auto add = [&](const std::vector<DeckTerm>& terms) {
    for (const DeckTerm& term : terms) {
      if (term.component % 3 != 0) nodes.insert(term.node);
    }
  };
  for (const DeckEquation& equation : deck.equations) add(equation.terms);
  for (const DeckSpring& spring : deck.springs) add(spring.terms);
  return nodes;
}

}  // namespace

DeckSites::DeckSites(const DeckConnections& deck, const DeckNodes& nodes, Mesh& mesh)
    : nodes_(nodes), mesh_(mesh), axes_(deck.axes) {
  const std::set<std::int64_t> radial = nodes_with_radial_directions(deck);
  for (auto& [node, axes] : axes_) {
    axes.origin_m *= nodes.length_unit_m;
    if (!axes.is_cylindrical || nodes.positions.count(node) == 0) continue;
    try {
      static_cast<void>(axes.at(position_m("", node)));
    } catch (const InputError&) {
      if (radial.count(node) > 0) {
        throw InputError(
            "node " + std::to_string(node) +
            " lies on the axis of its cylindrical coordinate system, where the radial and "
            "tangential directions are undefined; use another system, or fix both directions");
      }
      axes.is_cylindrical = false;  // both or neither direction is fixed: any pair of axes will do
    }
  }
}

Eigen::Vector3d DeckSites::position_m(const std::string& who, std::int64_t node) const {
  const auto found = nodes_.positions.find(node);
  if (found == nodes_.positions.end()) {
    throw InputError(who + " has node " + std::to_string(node) +
                     ", which the file does not define");
  }
  return nodes_.length_unit_m * Eigen::Vector3d(found->second.data());
}

std::int32_t DeckSites::site_of(const std::string& who, std::int64_t node) {
  if (is_of_solid(node)) return index_of(node);
  const auto rotation = rotation_nodes_.find(node);
  if (rotation != rotation_nodes_.end()) return rotation_site(mesh_.nodes.size(), rotation->second);
  const std::optional<std::int32_t> point = point_of(node);
  return translation_site(mesh_.nodes.size(), point ? *point : add_point(who, node));
}

bool DeckSites::is_rotation(std::int32_t site) const {
  const auto nodes = static_cast<std::int32_t>(mesh_.nodes.size());
  return site >= nodes && (site - nodes) % 2 == 1;
}

std::optional<std::int32_t> DeckSites::point_of(std::int64_t node) const {
  const auto found = points_.find(node);
  if (found == points_.end()) return std::nullopt;
  return found->second;
}

std::int32_t DeckSites::add_point(const std::string& who, std::int64_t node) {
  const Eigen::Vector3d x = position_m(who, node);
  std::vector<ReferencePoint>& points = mesh_.connections.points;
  points.push_back({"node " + std::to_string(node), {x[0], x[1], x[2]}});
  return points_[node] = static_cast<std::int32_t>(points.size()) - 1;
}

bool DeckSites::is_point(std::int64_t node) const {
  return !is_of_solid(node) && (points_.count(node) > 0 || rotation_nodes_.count(node) > 0);
}

const AxisSystem* DeckSites::axes_of(std::int64_t node) const {
  const auto found = axes_.find(node);
  return found == axes_.end() ? nullptr : &found->second;
}

Eigen::Matrix3d DeckSites::axes_at(const std::string& who, std::int64_t node) const {
  const AxisSystem* const axes = axes_of(node);
  if (axes == nullptr) return Eigen::Matrix3d::Identity();
  try {
    return axes->at(position_m(who, node));
  } catch (const InputError& error) {
    throw InputError(who + ": node " + std::to_string(node) + ": " + error.what());
  }
}

std::optional<Term> DeckSites::term_of(const std::string& who, const DeckTerm& term) {
  if (term.component < 1 || term.component > 6) {
    throw InputError(who + " has component " + std::to_string(term.component) +
                     " of a node, expected 1 to 6");
  }
  const bool turns = term.component > 3;
  std::int32_t site = site_of(who, term.node);
  if (turns) {
    const std::optional<std::int32_t> point = point_of(term.node);
    if (!point) return std::nullopt;
    site = rotation_site(mesh_.nodes.size(), *point);
  }
  // Where a deck adds lengths in its unit and angles, an angle counts as one unit of length.
  const bool is_angle = turns || rotation_nodes_.count(term.node) > 0;
  const Eigen::Vector3d direction = term.coefficient * (is_angle ? nodes_.length_unit_m : 1) *
                                    axes_at(who, term.node).col((term.component - 1) % 3);
  return Term{site, {direction[0], direction[1], direction[2]}};
}

std::set<std::int64_t> DeckSites::loose_nodes() const {
  std::set<std::int64_t> loose;
  for (const auto* const nodes : {&points_, &rotation_nodes_}) {
    for (const auto& [node, point] : *nodes) {
      if (!is_of_solid(node)) loose.insert(node);
    }
  }
  return loose;
}

}  // namespace flexneck::mesher
