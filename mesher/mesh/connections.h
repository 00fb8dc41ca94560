// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/mesh/axis_system.h"

namespace flexneck::mesher {

// The names are used in messages and contain the noun: "coupling 'tip'", "RBE2 5", "*EQUATION in
// line 17".

/// A point beside the nodes that moves with three translations and three rotations: the reference
/// of a rigid coupling, or a mass of its own.
struct ReferencePoint {
  std::string name;
  std::array<double, 3> position_m{};
};

/// Rigid coupling: nodes that follow a reference point as a rigid body, u = t + theta x (x -
/// point), in some directions.
struct Coupling {
  std::string name;
  std::int32_t point = 0;  ///< among the reference points
  std::vector<std::int32_t> nodes;
  std::array<bool, 3> directions = {true, true, true};  ///< x, y, z
};

/// Nodes that are fixed along some axes.
struct Support {
  std::string name;
  std::vector<std::int32_t> nodes;
  std::array<bool, 3> directions = {true, true, true};  ///< which of the axes are fixed
  AxisSystem axes = {};
};

/// A term of an equation: coefficients times the three degrees of freedom of a site. Sites are the
/// nodes, then for each reference point its translation and its rotation, see `translation_site()`.
struct Term {
  std::int32_t site = 0;
  std::array<double, 3> coefficients{};
};

/// Multi-point constraint: the sum of the terms is zero. The first term is dependent: its largest
/// coefficient belongs to the degree of freedom that the others determine. An equation of one term
/// is a support.
struct Equation {
  std::string name;
  std::vector<Term> terms;
};

/// Energy (1/2) k e^2 with the elongation e, the sum of the terms. A spring of one term acts to
/// ground.
struct Spring {
  std::string name;
  std::vector<Term> terms;
  double stiffness = 0;  ///< N/m; N m if the terms are rotations
};

/// A rigid body at a reference point, or at a node, where only its mass acts.
struct PointMass {
  std::string name;
  std::int32_t site = 0;  ///< a node, or the translation of a reference point
  double mass_kg = 0;
  std::array<double, 3> center_m{};  ///< relative to the point; zero at a node
  /// Inertia tensor about the centre: xx, yy, zz, xy, xz, yz; zero at a node.
  std::array<double, 6> inertia_kg_m2{};
};

/// Supports, couplings, equations, springs and masses of a mesh.
struct Connections {
  std::vector<ReferencePoint> points;
  std::vector<Coupling> couplings;
  std::vector<Support> supports;
  std::vector<Equation> equations;
  std::vector<Spring> springs;
  std::vector<PointMass> masses;

  bool empty() const {
    return points.empty() && couplings.empty() && supports.empty() && equations.empty() &&
           springs.empty() && masses.empty();
  }
  /// Text for messages with the numbers of all connections, such as "2 couplings, 1 spring".
  std::string text() const;
};

inline std::int32_t translation_site(std::size_t node_count, std::int32_t point) {
  return static_cast<std::int32_t>(node_count) + 2 * point;
}
inline std::int32_t rotation_site(std::size_t node_count, std::int32_t point) {
  return translation_site(node_count, point) + 1;
}

/// Checks that indices are in range, nodes ascending, names unique among points, couplings and
/// supports have nodes and a direction, terms are not zero, springs and masses are physical: a
/// positive stiffness, a mass that is not negative, an inertia without negative principal moments.
/// @throws InputError naming the first violation.
void check(const Connections& connections, std::size_t node_count);

}  // namespace flexneck::mesher
