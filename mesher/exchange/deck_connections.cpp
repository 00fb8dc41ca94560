// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/deck_connections.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

class Builder {
 public:
  Builder(const DeckConnections& deck, const DeckNodes& nodes, Mesh& mesh, LeftOut& left_out)
      : deck_(deck), nodes_(nodes), mesh_(mesh), left_out_(left_out), axes_(deck.axes) {
    for (auto& [node, axes] : axes_) axes.origin_m *= nodes.length_unit_m;
  }

  std::set<std::int64_t> loose_nodes() const {
    std::set<std::int64_t> loose;
    for (const auto* const nodes : {&points_, &rotation_nodes_}) {
      for (const auto& [node, point] : *nodes) {
        if (!is_of_solid(node)) loose.insert(node);
      }
    }
    return loose;
  }

  void build() {
    // Points first: sites of rotations are known then.
    for (const DeckCoupling& coupling : deck_.couplings) add(coupling);
    for (const DeckMass& mass : deck_.masses) site_of(mass.name, mass.node);
    for (const DeckSpring& spring : deck_.springs) {
      for (const DeckTerm& term : spring.terms) site_of(spring.name, term.node);
    }
    for (const DeckEquation& equation : deck_.equations) {
      for (const DeckTerm& term : equation.terms) site_of(equation.name, term.node);
    }
    for (const DeckEquation& equation : deck_.equations) add(equation);
    for (const DeckSupport& support : deck_.supports) add(support);
    for (auto& [key, support] : supports_) {
      std::sort(support.nodes.begin(), support.nodes.end());
      support.nodes.erase(std::unique(support.nodes.begin(), support.nodes.end()),
                          support.nodes.end());
      connections().supports.push_back(std::move(support));
    }
    for (const DeckSpring& spring : deck_.springs) add(spring);
    for (const DeckMass& mass : deck_.masses) add(mass);
  }

 private:
  Connections& connections() { return mesh_.connections; }
  std::int32_t node_count() const { return static_cast<std::int32_t>(mesh_.nodes.size()); }

  Eigen::Vector3d position_m(const std::string& who, std::int64_t node) const {
    const auto found = nodes_.positions.find(node);
    if (found == nodes_.positions.end()) {
      throw InputError(who + " has node " + std::to_string(node) +
                       ", which the file does not give");
    }
    return nodes_.length_unit_m * Eigen::Vector3d(found->second.data());
  }

  bool is_of_solid(std::int64_t node) const { return nodes_.index_of.count(node) > 0; }

  std::int32_t new_point(const std::string& name, const Eigen::Vector3d& x) {
    connections().points.push_back({name, {x[0], x[1], x[2]}});
    return static_cast<std::int32_t>(connections().points.size()) - 1;
  }

  /// Of a node's translations; a reference point is made for one that no element uses.
  std::int32_t site_of(const std::string& who, std::int64_t node) {
    const auto solid = nodes_.index_of.find(node);
    if (solid != nodes_.index_of.end()) return solid->second;
    const auto rotation = rotation_nodes_.find(node);
    if (rotation != rotation_nodes_.end()) {
      return rotation_site(mesh_.nodes.size(), rotation->second);
    }
    const auto found = points_.find(node);
    const std::int32_t point =
        found != points_.end()
            ? found->second
            : points_
                  .emplace(node, new_point("node " + std::to_string(node), position_m(who, node)))
                  .first->second;
    return translation_site(mesh_.nodes.size(), point);
  }

  /// Of a node's rotations: of a reference point, or of the coupling whose reference the node is.
  std::optional<std::int32_t> rotation_site_of(std::int64_t node) const {
    const auto found = points_.find(node);
    if (found == points_.end()) return std::nullopt;
    return rotation_site(mesh_.nodes.size(), found->second);
  }

  void add(const DeckCoupling& coupling) {
    Coupling result{coupling.name, 0, {}, coupling.directions};
    for (const std::int64_t node : coupling.nodes) {
      position_m(coupling.name, node);
      if (node == coupling.reference) continue;
      if (axes_.count(node) > 0 && coupling.directions != std::array<bool, 3>{true, true, true}) {
        throw InputError(coupling.name + " couples some directions of node " +
                         std::to_string(node) + ", which has axes of its own");
      }
      if (is_of_solid(node)) {
        result.nodes.push_back(nodes_.index_of.at(node));
      } else {
        left_out_.add("nodes of no solid element in couplings");
      }
    }
    if (result.nodes.empty()) throw InputError(coupling.name + " has no nodes that elements use");
    std::sort(result.nodes.begin(), result.nodes.end());
    result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());
    const auto known = points_.find(coupling.reference);
    if (known != points_.end()) {
      result.point = known->second;
    } else {
      const Eigen::Vector3d x = position_m(coupling.name, coupling.reference);
      result.point = new_point("node " + std::to_string(coupling.reference), x);
      points_[coupling.reference] = result.point;
      if (is_of_solid(coupling.reference)) follow_node(coupling, result.point);
    }
    if (coupling.rotation != 0) rotation_nodes_[coupling.rotation] = result.point;
    connections().couplings.push_back(std::move(result));
  }

  /// The reference is a node of elements: the point's translations are its.
  void follow_node(const DeckCoupling& coupling, std::int32_t point) {
    const std::int32_t site = translation_site(mesh_.nodes.size(), point);
    for (std::size_t a = 0; a < 3; ++a) {
      Term of_point{site, {}};
      Term of_node{nodes_.index_of.at(coupling.reference), {}};
      of_point.coefficients[a] = 1;
      of_node.coefficients[a] = -1;
      connections().equations.push_back({coupling.name, {of_point, of_node}});
    }
  }

  Eigen::Matrix3d axes_at(const std::string& who, std::int64_t node) const {
    const auto found = axes_.find(node);
    if (found == axes_.end()) return Eigen::Matrix3d::Identity();
    try {
      return found->second.at(position_m(who, node));
    } catch (const InputError& error) {
      throw InputError(who + ": node " + std::to_string(node) + ": " + error.what());
    }
  }

  /// Nothing for a rotation of a node of solids.
  std::optional<Term> term_of(const std::string& who, const DeckTerm& term) {
    if (term.component < 1 || term.component > 6) {
      throw InputError(who + " has component " + std::to_string(term.component) +
                       " of a node, expected 1 to 6");
    }
    const bool is_rotation = term.component > 3;
    std::int32_t site = site_of(who, term.node);
    double coefficient = term.coefficient;
    if (is_rotation) {
      const auto rotation = rotation_site_of(term.node);
      if (!rotation) return std::nullopt;
      site = *rotation;
    }
    // Of lengths in the deck's unit and angles that are added, angles weigh as such a length.
    if (is_rotation || rotation_nodes_.count(term.node) > 0) coefficient *= nodes_.length_unit_m;
    const Eigen::Vector3d direction =
        coefficient * axes_at(who, term.node).col((term.component - 1) % 3);
    return Term{site, {direction[0], direction[1], direction[2]}};
  }

  void add(const DeckEquation& equation) {
    Equation result{equation.name, {}};
    for (const DeckTerm& term : equation.terms) {
      if (term.coefficient == 0 && &term != &equation.terms.front()) continue;
      if (term.coefficient == 0) {
        throw InputError(equation.name +
                         ": the coefficient of the dependent degree of freedom is 0");
      }
      const auto ours = term_of(equation.name, term);
      if (!ours) {
        throw InputError(equation.name + " has a rotation of node " + std::to_string(term.node) +
                         ", which solids do not give one");
      }
      result.terms.push_back(*ours);
    }
    connections().equations.push_back(std::move(result));
  }

  void add(const DeckSupport& support) {
    position_m(support.name, support.node);
    const auto solid = nodes_.index_of.find(support.node);
    if (solid != nodes_.index_of.end() && points_.count(support.node) == 0) {
      add_to_set(support, solid->second);
      return;
    }
    if (!is_of_solid(support.node) && points_.count(support.node) == 0 &&
        rotation_nodes_.count(support.node) == 0) {
      left_out_.add("supports of nodes of no solid element");
      return;
    }
    for (int component = 1; component <= 6; ++component) {
      if (!support.components[static_cast<std::size_t>(component - 1)]) continue;
      const auto term = term_of(support.name, {support.node, component, 1});
      if (term) connections().equations.push_back({support.name, {*term}});
    }
  }

  /// Nodes of one name, one axis system and the same directions are one support.
  void add_to_set(const DeckSupport& support, std::int32_t node) {
    const std::array<bool, 3> directions = {support.components[0], support.components[1],
                                            support.components[2]};
    if (directions == std::array<bool, 3>{}) return;  // rotations, which solids do not have
    AxisSystem axes;
    const auto found = axes_.find(support.node);
    if (found != axes_.end()) axes = found->second;
    std::array<double, 13> numbers{};
    std::copy(axes.axes.data(), axes.axes.data() + 9, numbers.begin());
    std::copy(axes.origin_m.data(), axes.origin_m.data() + 3, numbers.begin() + 9);
    numbers[12] = axes.is_cylindrical ? 1 : 0;
    Support& set = supports_[{support.name, directions, numbers}];
    set.name = support.name;
    set.directions = directions;
    set.axes = axes;
    set.nodes.push_back(node);
  }

  void add(const DeckSpring& spring) {
    if (spring.is_along_nodes) {
      add_along_nodes(spring);
      return;
    }
    Spring result{spring.name, {}, spring.stiffness};
    bool has_translation = false;
    bool has_rotation = false;
    for (const DeckTerm& term : spring.terms) {
      const auto ours = term_of(spring.name, {term.node, term.component, 1});
      if (!ours) {
        left_out_.add("springs at rotations of nodes of solids");
        return;
      }
      const bool is_rotation = ours->site >= node_count() && (ours->site - node_count()) % 2 == 1;
      has_rotation = has_rotation || is_rotation;
      has_translation = has_translation || !is_rotation;
      // The stiffness has the unit.
      Term weighted = *ours;
      const double length = is_rotation ? nodes_.length_unit_m : 1;
      for (double& c : weighted.coefficients) c *= term.coefficient / length;
      result.terms.push_back(weighted);
    }
    if (has_translation && has_rotation) {
      throw InputError(spring.name + " joins a translation and a rotation, which is not supported");
    }
    result.stiffness *= has_rotation ? nodes_.force_unit_N * nodes_.length_unit_m
                                     : nodes_.force_unit_N / nodes_.length_unit_m;
    connections().springs.push_back(std::move(result));
  }

  void add_along_nodes(const DeckSpring& spring) {
    const std::int64_t one = spring.terms.at(0).node;
    const std::int64_t two = spring.terms.at(1).node;
    const Eigen::Vector3d line = position_m(spring.name, two) - position_m(spring.name, one);
    if (!(line.norm() > 0)) throw InputError(spring.name + " has its two nodes in the same place");
    const Eigen::Vector3d along = line.normalized();
    connections().springs.push_back(
        {spring.name,
         {{site_of(spring.name, one), {-along[0], -along[1], -along[2]}},
          {site_of(spring.name, two), {along[0], along[1], along[2]}}},
         spring.stiffness * nodes_.force_unit_N / nodes_.length_unit_m});
  }

  void add(const DeckMass& mass) {
    const double length = nodes_.length_unit_m;
    PointMass result{mass.name, site_of(mass.name, mass.node),
                     mass.mass * nodes_.force_unit_N / length, mass.center, mass.inertia};
    for (double& x : result.center_m) x *= length;
    for (double& i : result.inertia_kg_m2) i *= nodes_.force_unit_N * length;
    const auto point = points_.find(mass.node);
    const auto is_zero = [](double value) { return value == 0; };
    const bool turns = !std::all_of(mass.center.begin(), mass.center.end(), is_zero) ||
                       !std::all_of(mass.inertia.begin(), mass.inertia.end(), is_zero);
    if (point != points_.end()) {
      result.site = translation_site(mesh_.nodes.size(), point->second);
    } else if (turns) {
      left_out_.add("offsets and inertias of masses at nodes of solids");
      result.center_m = {};
      result.inertia_kg_m2 = {};
    }
    connections().masses.push_back(std::move(result));
  }

  using SupportKey = std::tuple<std::string, std::array<bool, 3>, std::array<double, 13>>;

  const DeckConnections& deck_;
  const DeckNodes& nodes_;
  Mesh& mesh_;
  LeftOut& left_out_;
  std::map<std::int64_t, AxisSystem> axes_;              ///< their origins in m
  std::map<std::int64_t, std::int32_t> points_;          ///< by node
  std::map<std::int64_t, std::int32_t> rotation_nodes_;  ///< point of a node that has its rotations
  std::map<SupportKey, Support> supports_;
};

}  // namespace

std::set<std::int64_t> add_connections(const DeckConnections& deck, const DeckNodes& nodes,
                                       Mesh& mesh, LeftOut& left_out) {
  Builder builder(deck, nodes, mesh, left_out);
  builder.build();
  return builder.loose_nodes();
}

}  // namespace flexneck::mesher
