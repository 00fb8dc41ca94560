// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/body_constraints.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/held_points.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::fe_modal {
namespace {

/// Maps each node to the lowest of those tied together. Where cuts cross, more than two nodes are
/// one.
class TiedNodes {
 public:
  TiedNodes(std::size_t node_count, std::span<const mesher::Slit> slits) : next_(node_count) {
    std::iota(next_.begin(), next_.end(), 0);
    for (const mesher::Slit& slit : slits) {
      for (std::size_t p = 0; slit.tied && p < slit.lower.size(); ++p) {
        tie(slit.lower[p], slit.upper[p]);
      }
    }
  }

  /// Lowest node tied to a site. Sites behind the nodes are tied to nothing.
  std::int32_t lowest(std::int32_t site) const {
    if (static_cast<std::size_t>(site) >= next_.size()) return site;
    while (next_[static_cast<std::size_t>(site)] != site) {
      site = next_[static_cast<std::size_t>(site)];
    }
    return site;
  }

  void add_to(AffineConstraints& constraints) const {
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(next_.size()); ++node) {
      const std::int32_t other = lowest(node);
      for (std::int32_t a = 0; a < 3 && other != node; ++a) {
        const DofTerm same{3 * other + a, 1};
        constraints.add_line(3 * node + a, std::span(&same, 1), "a closed slit");
      }
    }
  }

 private:
  void tie(std::int32_t one, std::int32_t other) {
    const std::int32_t a = lowest(one);
    const std::int32_t b = lowest(other);
    next_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

  std::vector<std::int32_t> next_;  ///< a lower node tied to each, or itself
};

/// Name of a degree of freedom: "x of the node at (0, 0, 0.3) m", "the rotation about z of point
/// 'tip'".
std::string name_of(const mesher::Mesh& mesh, const mesher::Connections& connections,
                    std::int32_t dof) {
  const std::string axis(1, "xyz"[dof % 3]);
  const auto site = static_cast<std::size_t>(dof / 3);
  if (site >= mesh.nodes.size()) {
    const std::size_t half = site - mesh.nodes.size();
    return (half % 2 == 0 ? axis : "the rotation about " + axis) + " of " +
           connections.points[half / 2].name;
  }
  return axis + " of the node at (" + rounded_texts(mesh.nodes[site]) + ") m";
}

using Terms = std::vector<DofTerm>;

/// Adds the lines of a coupling, u = t + theta x arm.
void add_coupling(const mesher::Mesh& mesh, const mesher::Connections& connections,
                  const mesher::Coupling& coupling, const TiedNodes& tied,
                  AffineConstraints& constraints) {
  const std::int32_t translation = mesher::translation_site(mesh.nodes.size(), coupling.point);
  const std::int32_t rotation = mesher::rotation_site(mesh.nodes.size(), coupling.point);
  const auto& point = connections.points[static_cast<std::size_t>(coupling.point)].position_m;
  for (const std::int32_t node : coupling.nodes) {
    const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
    for (std::int32_t a = 0; a < 3; ++a) {
      if (!coupling.directions[static_cast<std::size_t>(a)]) continue;
      const std::int32_t b = (a + 1) % 3;
      const std::int32_t c = (a + 2) % 3;
      const auto arm = [&](std::int32_t d) {
        return x[static_cast<std::size_t>(d)] - point[static_cast<std::size_t>(d)];
      };
      Terms terms = {{3 * translation + a, 1}};
      if (arm(c) != 0) terms.push_back({3 * rotation + b, arm(c)});
      if (arm(b) != 0) terms.push_back({3 * rotation + c, -arm(b)});
      constraints.add_line(3 * tied.lowest(node) + a, terms, coupling.name);
    }
  }
}

Terms terms_of(const std::vector<mesher::Term>& sum, const TiedNodes& tied) {
  Terms terms;
  for (const mesher::Term& term : sum) {
    for (std::int32_t a = 0; a < 3; ++a) {
      const double coefficient = term.coefficients[static_cast<std::size_t>(a)];
      if (coefficient != 0) terms.push_back({3 * tied.lowest(term.site) + a, coefficient});
    }
  }
  return terms;
}

/// An equation of several terms. The dependent degree of freedom is the one with the largest
/// coefficient at the first site.
struct NamedEquation {
  NamedEquation(const mesher::Equation& equation, const TiedNodes& tied)
      : terms(terms_of(equation.terms, tied)), name(equation.name) {
    const std::int32_t site = terms.front().dof / 3;
    for (std::size_t k = 0; k < terms.size() && terms[k].dof / 3 == site; ++k) {
      if (std::abs(terms[k].coefficient) > std::abs(terms[dependent].coefficient)) dependent = k;
    }
  }

  /// Returns whether the dependent degree of freedom moves at most a hundred times as far as
  /// others, so that their differences keep significant digits of it.
  bool is_well_scaled(const AffineConstraints& constraints) const {
    constexpr double kLeast = 1e-2;
    return constraints.size_of(std::span(terms).subspan(dependent, 1)) >=
           kLeast * constraints.size_of(terms);
  }

  void add_to(AffineConstraints& constraints) const {
    const DofTerm chosen = terms[dependent];
    Terms others = terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(dependent));
    for (DofTerm& term : others) term.coefficient /= -chosen.coefficient;
    constraints.add_line(chosen.dof, others, name);
  }

  Terms terms;
  const std::string& name;
  std::size_t dependent = 0;
};

/// Adds the equations of several terms. If the dependent degree of freedom has a small coefficient
/// another one takes its place, after all other equations are added.
void add_equations(const mesher::Connections& connections, const TiedNodes& tied,
                   AffineConstraints& constraints) {
  std::vector<NamedEquation> later;
  for (const mesher::Equation& equation : connections.equations) {
    if (equation.terms.size() == 1) continue;
    NamedEquation named(equation, tied);
    if (named.is_well_scaled(constraints)) {
      named.add_to(constraints);
    } else {
      later.push_back(std::move(named));
    }
  }
  for (const NamedEquation& named : later) constraints.add_equation(named.terms, named.name);
}

void add_support(const mesher::Mesh& mesh, const mesher::Support& support,
                 AffineConstraints& constraints) {
  for (const std::int32_t node : support.nodes) {
    Eigen::Matrix3d axes;
    try {
      axes = support.axes.at(
          Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data()));
    } catch (const InputError& error) {
      throw InputError(support.name + ": " + error.what());
    }
    for (Eigen::Index d = 0; d < 3; ++d) {
      if (!support.directions[static_cast<std::size_t>(d)]) continue;
      Terms terms;
      for (std::int32_t a = 0; a < 3; ++a) {
        if (axes(a, d) != 0) terms.push_back({3 * node + a, axes(a, d)});
      }
      constraints.add_equation(terms, support.name);
    }
  }
}

void fix(std::span<const std::int32_t> nodes, AffineConstraints& constraints) {
  for (const std::int32_t node : nodes) {
    for (std::int32_t a = 0; a < 3; ++a) {
      const DofTerm term{3 * node + a, 1};
      constraints.add_equation(std::span(&term, 1), "a fixed node");
    }
  }
}

}  // namespace

AffineConstraints tie_and_fix(std::size_t node_count, std::span<const std::int32_t> fixed,
                              std::span<const mesher::Slit> slits) {
  AffineConstraints constraints(3 * static_cast<std::int32_t>(node_count), {},
                                [](std::int32_t dof) { return std::to_string(dof); });
  TiedNodes(node_count, slits).add_to(constraints);
  fix(fixed, constraints);
  return constraints;
}

AffineConstraints constraints_of(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
                                 const mesher::Connections& connections) {
  const std::size_t nodes = mesh.nodes.size();
  std::vector<double> scales(3 * (nodes + 2 * connections.points.size()), 1);
  const double length_m = mesher::bounding_box(mesh).extent_m().norm();
  for (std::size_t p = 0; p < connections.points.size(); ++p) {
    const auto rotation = scales.begin() + static_cast<std::ptrdiff_t>(3 * (nodes + 2 * p + 1));
    std::fill(rotation, rotation + 3, length_m);
  }
  const auto dofs = static_cast<std::int32_t>(scales.size());
  AffineConstraints constraints(dofs, std::move(scales),
                                [&](std::int32_t dof) { return name_of(mesh, connections, dof); });
  const TiedNodes tied(nodes, mesh.slits);
  tied.add_to(constraints);
  for (const mesher::Coupling& coupling : connections.couplings) {
    add_coupling(mesh, connections, coupling, tied, constraints);
  }
  add_equations(connections, tied, constraints);
  hold_points(mesh, connections, constraints);
  for (const mesher::Equation& equation : connections.equations) {
    if (equation.terms.size() > 1) continue;
    constraints.add_equation(terms_of(equation.terms, tied), equation.name);
  }
  for (const mesher::Support& support : connections.supports) {
    add_support(mesh, support, constraints);
  }
  fix(fixed, constraints);
  return constraints;
}

}  // namespace flexneck::fe_modal
