// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/deck_connections.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/exchange/deck_sites.h"

namespace flexneck::mesher {
namespace {

class Builder {
 public:
  Builder(const DeckConnections& deck, const DeckNodes& nodes, Mesh& mesh, LeftOut& left_out)
      : deck_(deck), nodes_(nodes), mesh_(mesh), left_out_(left_out), sites_(deck, nodes, mesh) {}

  void build() {
    // Reference points come first: the sites of rotations are then known.
    for (const DeckCoupling& coupling : deck_.couplings) add(coupling);
    for (const DeckMass& mass : deck_.masses) sites_.site_of(mass.name, mass.node);
    for (const DeckSpring& spring : deck_.springs) {
      for (const DeckTerm& term : spring.terms) sites_.site_of(spring.name, term.node);
    }
    for (const DeckEquation& equation : deck_.equations) {
      for (const DeckTerm& term : equation.terms) sites_.site_of(equation.name, term.node);
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
    refuse_chains();
  }

  std::set<std::int64_t> loose_nodes() const { return sites_.loose_nodes(); }

 private:
  Connections& connections() { return mesh_.connections; }

  void add(const DeckCoupling& coupling) {
    Coupling result{coupling.name, 0, {}, coupling.directions};
    for (const std::int64_t node : coupling.nodes) {
      sites_.position_m(coupling.name, node);
      if (node == coupling.reference || node == coupling.rotation) continue;
      if (sites_.axes_of(node) != nullptr &&
          coupling.directions != std::array<bool, 3>{true, true, true}) {
        throw InputError(coupling.name + " couples some directions of node " +
                         std::to_string(node) + ", which has its own coordinate axes");
      }
      if (sites_.is_of_solid(node)) {
        result.nodes.push_back(sites_.index_of(node));
      } else {
        left_out_.add("nodes of no solid element in couplings");
      }
    }
    if (result.nodes.empty())
      throw InputError(coupling.name + " has no nodes that belong to elements");
    std::sort(result.nodes.begin(), result.nodes.end());
    result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());
    const std::optional<std::int32_t> known = sites_.point_of(coupling.reference);
    if (known) {
      result.point = *known;
    } else {
      result.point = sites_.add_point(coupling.name, coupling.reference);
      if (sites_.is_of_solid(coupling.reference)) follow_node(coupling, result.point);
    }
    if (coupling.rotation != 0) sites_.set_rotation_node(coupling.rotation, result.point);
    connections().couplings.push_back(std::move(result));
  }

  /// Couples a point to a node of elements that is its reference: the translations of both are
  /// equal.
  void follow_node(const DeckCoupling& coupling, std::int32_t point) {
    const std::int32_t site = translation_site(mesh_.nodes.size(), point);
    for (std::size_t a = 0; a < 3; ++a) {
      Term of_point{site, {}};
      Term of_node{sites_.index_of(coupling.reference), {}};
      of_point.coefficients[a] = 1;
      of_node.coefficients[a] = -1;
      connections().equations.push_back({coupling.name, {of_point, of_node}});
    }
  }

  void add(const DeckEquation& equation) {
    Equation result{equation.name, {}};
    for (const DeckTerm& term : equation.terms) {
      if (term.coefficient == 0 && &term != &equation.terms.front()) continue;
      if (term.coefficient == 0) {
        throw InputError(equation.name +
                         ": the coefficient of the dependent degree of freedom is 0");
      }
      const auto ours = sites_.term_of(equation.name, term);
      if (!ours) {
        throw InputError(equation.name + " has a rotation of node " + std::to_string(term.node) +
                         ", but nodes of solid elements have no rotations");
      }
      result.terms.push_back(*ours);
    }
    connections().equations.push_back(std::move(result));
  }

  void add(const DeckSupport& support) {
    sites_.position_m(support.name, support.node);
    const bool is_of_solid = sites_.is_of_solid(support.node);
    if (is_of_solid && !sites_.point_of(support.node)) {
      add_to_set(support, sites_.index_of(support.node));
      return;
    }
    if (!is_of_solid && !sites_.is_point(support.node)) {
      left_out_.add("supports of nodes of no solid element");
      return;
    }
    for (int component = 1; component <= 6; ++component) {
      if (!support.components[static_cast<std::size_t>(component - 1)]) continue;
      const auto term = sites_.term_of(support.name, {support.node, component, 1});
      if (term) connections().equations.push_back({support.name, {*term}});
    }
  }

  /// Adds a node to a support. Nodes with the same name, axis system and directions form one
  /// support.
  void add_to_set(const DeckSupport& support, std::int32_t node) {
    const std::array<bool, 3> directions = {support.components[0], support.components[1],
                                            support.components[2]};
    if (directions == std::array<bool, 3>{}) return;  // only rotations, which solids do not have
    const AxisSystem* const own = sites_.axes_of(support.node);
    const AxisSystem axes = own != nullptr ? *own : AxisSystem();
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
      const auto ours = sites_.term_of(spring.name, {term.node, term.component, 1});
      if (!ours) {
        left_out_.add("springs at rotations of nodes of solids");
        return;
      }
      const bool is_rotation = sites_.is_rotation(ours->site);
      has_rotation = has_rotation || is_rotation;
      has_translation = has_translation || !is_rotation;
      // The stiffness carries the unit, so the coefficient is in the deck's.
      Term weighted = *ours;
      const double length = is_rotation ? nodes_.length_unit_m : 1;
      for (double& c : weighted.coefficients) c *= term.coefficient / length;
      result.terms.push_back(weighted);
    }
    if (has_translation && has_rotation) {
      throw InputError(spring.name +
                       " connects a translation with a rotation, which is not supported");
    }
    result.stiffness *= has_rotation ? nodes_.force_unit_N * nodes_.length_unit_m
                                     : nodes_.force_unit_N / nodes_.length_unit_m;
    connections().springs.push_back(std::move(result));
  }

  void add_along_nodes(const DeckSpring& spring) {
    const std::int64_t one = spring.terms.at(0).node;
    const std::int64_t two = spring.terms.at(1).node;
    const Eigen::Vector3d line =
        sites_.position_m(spring.name, two) - sites_.position_m(spring.name, one);
    if (!(line.norm() > 0)) throw InputError(spring.name + " has two coincident nodes");
    const Eigen::Vector3d along = line.normalized();
    connections().springs.push_back(
        {spring.name,
         {{sites_.site_of(spring.name, one), {-along[0], -along[1], -along[2]}},
          {sites_.site_of(spring.name, two), {along[0], along[1], along[2]}}},
         spring.stiffness * nodes_.force_unit_N / nodes_.length_unit_m});
  }

  void add(const DeckMass& mass) {
    const double length = nodes_.length_unit_m;
    PointMass result{mass.name, sites_.site_of(mass.name, mass.node),
                     mass.mass * nodes_.force_unit_N / length, mass.center, mass.inertia};
    for (double& x : result.center_m) x *= length;
    for (double& i : result.inertia_kg_m2) i *= nodes_.force_unit_N * length;
    const std::optional<std::int32_t> point = sites_.point_of(mass.node);
    const auto is_zero = [](double value) { return value == 0; };
    const bool turns = !std::all_of(mass.center.begin(), mass.center.end(), is_zero) ||
                       !std::all_of(mass.inertia.begin(), mass.inertia.end(), is_zero);
    if (point) {
      result.site = translation_site(mesh_.nodes.size(), *point);
    } else if (turns) {
      left_out_.add("offsets and inertias of masses at nodes of solids");
      result.center_m = {};
      result.inertia_kg_m2 = {};
    }
    connections().masses.push_back(std::move(result));
  }

  /// Refuses couplings of nodes that no element uses but another coupling, equation, spring or mass
  /// does. Other unused nodes may be left out of a coupling.
  void refuse_chains() const {
    for (const DeckCoupling& coupling : deck_.couplings) {
      for (const std::int64_t node : coupling.nodes) {
        if (node == coupling.reference || node == coupling.rotation) continue;
        if (!sites_.is_point(node)) continue;
        throw InputError(coupling.name + " has node " + std::to_string(node) +
                         ", which belongs to no element, but to another coupling, equation, spring "
                         "or mass; use nodes of elements instead");
      }
    }
  }

  using SupportKey = std::tuple<std::string, std::array<bool, 3>, std::array<double, 13>>;

  const DeckConnections& deck_;
  const DeckNodes& nodes_;
  Mesh& mesh_;
  LeftOut& left_out_;
  DeckSites sites_;
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
