// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/connections.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::mesher {
namespace {

void check_nodes(const std::vector<std::int32_t>& nodes, std::size_t node_count,
                 const std::string& who) {
  if (nodes.empty()) throw InputError(who + " has no nodes");
  for (const std::int32_t node : nodes) {
    if (node < 0 || static_cast<std::size_t>(node) >= node_count) {
      throw InputError(who + " refers to node " + std::to_string(node) + ", but there are " +
                       std::to_string(node_count) + " nodes, counted from 0");
    }
  }
  if (std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) != nodes.end()) {
    throw InputError(who + " has nodes that are not in ascending order");
  }
}

void check_directions(const std::array<bool, 3>& directions, const std::string& who) {
  if (directions == std::array<bool, 3>{}) throw InputError(who + " has no direction");
}

void check_terms(const std::vector<Term>& terms, std::size_t site_count, const std::string& who) {
  if (terms.empty()) throw InputError(who + " has no terms");
  for (const Term& term : terms) {
    if (term.site < 0 || static_cast<std::size_t>(term.site) >= site_count) {
      throw InputError(who + " refers to site " + std::to_string(term.site) + ", but there are " +
                       std::to_string(site_count) + ", counted from 0");
    }
    const auto& [x, y, z] = term.coefficients;
    if (!(std::isfinite(x) && std::isfinite(y) && std::isfinite(z) &&
          (x != 0 || y != 0 || z != 0))) {
      throw InputError(who + " has a term whose direction is zero or not finite");
    }
  }
}

void check_mass(const PointMass& mass, std::size_t node_count, std::size_t site_count) {
  const std::string& who = mass.name;
  const auto site = static_cast<std::size_t>(mass.site);
  const bool is_node = mass.site >= 0 && site < node_count;
  if (!is_node && (mass.site < 0 || site >= site_count || (site - node_count) % 2 != 0)) {
    throw InputError(who + " is at site " + std::to_string(mass.site) +
                     ", which is neither a node nor a reference point");
  }
  const auto is_zero = [](double value) { return value == 0; };
  const auto& i = mass.inertia_kg_m2;
  Eigen::Matrix3d tensor;
  tensor << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  if (!(mass.mass_kg >= 0 && std::isfinite(mass.mass_kg) && tensor.allFinite() &&
        std::all_of(mass.center_m.begin(), mass.center_m.end(),
                    [](double x) { return std::isfinite(x); }))) {
    throw InputError(who + " must have a mass of at least 0 and finite values");
  }
  constexpr double kRounding = 1e-12;
  if (Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor).eigenvalues()[0] <
      -kRounding * tensor.norm()) {
    throw InputError(who + " has a negative principal moment of inertia");
  }
  if (is_node && !(std::all_of(mass.center_m.begin(), mass.center_m.end(), is_zero) &&
                   std::all_of(i.begin(), i.end(), is_zero))) {
    throw InputError(who +
                     " has an offset or an inertia at a node, which has no rotations; use a "
                     "reference point that is coupled to nodes");
  }
}

}  // namespace

std::string Connections::text() const {
  std::string text;
  const auto add = [&](std::size_t count, const std::string& one, const std::string& many) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + (count > 1 ? many : one);
  };
  add(points.size(), "reference point", "reference points");
  add(couplings.size(), "coupling", "couplings");
  add(supports.size(), "support", "supports");
  add(equations.size(), "equation", "equations");
  add(springs.size(), "spring", "springs");
  add(masses.size(), "point mass", "point masses");
  return text;
}

void check(const Connections& connections, std::size_t node_count) {
  const std::size_t site_count = node_count + 2 * connections.points.size();
  check_names(names_of(connections.points), "reference point");
  for (const Coupling& coupling : connections.couplings) {
    const std::string& who = coupling.name;
    check_nodes(coupling.nodes, node_count, who);
    check_directions(coupling.directions, who);
    if (coupling.point < 0 ||
        static_cast<std::size_t>(coupling.point) >= connections.points.size()) {
      throw InputError(who + " has no reference point");
    }
  }
  for (const Support& support : connections.supports) {
    const std::string& who = support.name;
    check_nodes(support.nodes, node_count, who);
    check_directions(support.directions, who);
  }
  for (const Equation& equation : connections.equations) {
    check_terms(equation.terms, site_count, equation.name);
  }
  for (const Spring& spring : connections.springs) {
    check_terms(spring.terms, site_count, spring.name);
    if (!(spring.stiffness > 0 && std::isfinite(spring.stiffness))) {
      throw InputError(spring.name + " must have a stiffness > 0");
    }
  }
  for (const PointMass& mass : connections.masses) check_mass(mass, node_count, site_count);
}

}  // namespace flexneck::mesher
