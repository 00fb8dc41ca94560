// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/modes_connections.h"

#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/rigid_body.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {
namespace {

constexpr Key kCouplingKeys[] = {
    Key::text("name", kRequired, "Name of the coupling and of its reference point"),
    Key::text("set", kNone,
              "Face set or node set that is coupled (default: the set with the coupling's name)"),
    Key::quantities("position", "m", kRequired, "Reference point", {.size = 3}),
    Key::text("directions", "xyz", "Directions in which the nodes follow the reference point"),
};

constexpr Key kSupportKeys[] = {
    Key::text("at", kRequired, "Node set or coupling that is fixed"),
    Key::text("directions", kNone,
              "Fixed directions, such as \"x\" or \"yz\"; with an axis, letters of \"rtz\": "
              "radial, tangential and axial"),
    Key::text("turns", kNone, "Fixed rotations of a coupling, such as \"x\" or \"yz\""),
    Key::numbers("direction", kNone,
                 "Instead of directions: vector along which the motion is fixed", {.size = 3}),
    Key::numbers("axis", kNone, "Axis of the cylindrical directions", {.size = 3}),
    Key::quantities("origin", "m", kNone, "A point on that axis (default: the origin)",
                    {.size = 3}),
};

constexpr Key kTermKeys[] = {
    Key::text("at", kRequired, "Node set with one node, or coupling"),
    Key::numbers("direction", kRequired, "Direction of the motion, multiplied by its coefficient",
                 {.size = 3}),
    Key::flag(
        "rotation", "false",
        "Use the rotation of a coupling about the direction, in rad, instead of its displacement"),
};

constexpr Key kEquationKeys[] = {
    Key::text("name", kRequired, "Name of the equation"),
    Key::tables("term", "Terms whose sum is zero, in m; the first term is the dependent one",
                kTermKeys),
};

constexpr Key kSpringKeys[] = {
    Key::text("name", kRequired, "Name of the spring"),
    Key::texts("between", kRequired,
               "Node sets with one node, or couplings: one for a spring to ground, or two"),
    Key::numbers("direction", kNone,
                 "Direction in which the spring acts (default: the line between its two ends)",
                 {.size = 3}),
    Key::quantity("stiffness", "N/m", kNone, "Stiffness", {.range = kPositive}),
    Key::quantity("torsional_stiffness", "N m/rad", kNone,
                  "Instead of stiffness: torsional stiffness about the direction",
                  {.range = kPositive}),
};

constexpr auto kMassKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the mass"),
        Key::text("at", kRequired, "Node set with one node, or coupling, that carries the mass"),
    }),
    kRigidBodyKeys);

constexpr Key kKeys[] = {
    Key::tables("coupling", "Couplings: nodes that follow a reference point as a rigid body",
                kCouplingKeys),
    Key::tables("support", "Supports of nodes and couplings in some directions", kSupportKeys),
    Key::tables("equation", "Linear constraint equations between motions", kEquationKeys),
    Key::tables("spring", "Springs to ground or between nodes and couplings", kSpringKeys),
    Key::tables("point_mass", "Point masses: rigid bodies at nodes and couplings", kMassKeys),
};

/// Directions named by letters: "xz" means x and z.
std::array<bool, 3> read_directions(const StudyTable& table, const std::string& key,
                                    std::string_view letters) {
  std::array<bool, 3> directions{};
  const std::string text = table.text(key);
  if (text.empty() || text.find_first_not_of(letters) != std::string::npos) {
    table.refuse(key, "expected some of the letters \"" + std::string(letters) + "\", found \"" +
                          text + "\"");
  }
  for (const char letter : text) directions[letters.find(letter)] = true;
  return directions;
}

Eigen::Vector3d read_vector(const StudyTable& table, const std::string& key) {
  const std::vector<double> numbers = table.numbers(key);
  const Eigen::Vector3d vector(numbers[0], numbers[1], numbers[2]);
  if (!(vector.norm() > 0)) table.refuse(key, "expected a direction, found a zero vector");
  return vector;
}

CouplingSection read_coupling(const StudyTable& table) {
  CouplingSection coupling;
  coupling.name = table.text("name");
  coupling.set = table.text_or("set", coupling.name);
  coupling.position_m = quantity_vector(table, "position");
  coupling.directions = read_directions(table, "directions", "xyz");
  table.finish();
  return coupling;
}

SupportSection read_support(const StudyTable& table) {
  SupportSection support;
  support.at = table.text("at");
  if (table.has("direction")) {
    table.refuse_given({"directions", "axis", "origin"},
                       "expected directions or direction, found both");
    support.directions = {false, false, true};
    support.axes.axes = mesher::axes_from(read_vector(table, "direction"), Eigen::Vector3d::Zero());
  } else if (table.has("directions")) {
    support.axes.is_cylindrical = table.has("axis");
    support.directions =
        read_directions(table, "directions", support.axes.is_cylindrical ? "rtz" : "xyz");
  } else if (!table.has("turns")) {
    table.refuse("directions", "expected one of directions, direction and turns");
  }
  if (table.has("axis")) {
    support.axes.axes = mesher::axes_from(read_vector(table, "axis"), Eigen::Vector3d::Zero());
    if (table.has("origin")) support.axes.origin_m = quantity_vector(table, "origin");
  } else if (table.has("origin")) {
    table.refuse("origin", "expected an axis as well");
  }
  if (table.has("turns")) support.turns = read_directions(table, "turns", "xyz");
  table.finish();
  return support;
}

EquationSection read_equation(const StudyTable& table) {
  EquationSection equation;
  equation.name = table.text("name");
  for (const StudyTable& term : table.tables("term")) {
    equation.terms.push_back(
        {term.text("at"), read_vector(term, "direction"), term.flag("rotation")});
    term.finish();
  }
  if (equation.terms.size() < 2) {
    table.refuse("term", "expected at least two terms, found " +
                             std::to_string(equation.terms.size()) +
                             "; use a support to fix a single motion");
  }
  table.finish();
  return equation;
}

SpringSection read_spring(const StudyTable& table) {
  SpringSection spring;
  spring.name = table.text("name");
  spring.between = table.texts("between");
  if (spring.between.empty() || spring.between.size() > 2) {
    table.refuse("between",
                 "expected one or two names, found " + std::to_string(spring.between.size()));
  }
  if (table.has("direction")) {
    spring.direction = read_vector(table, "direction").normalized();
  } else if (spring.between.size() == 1) {
    table.refuse("direction", "expected the direction of a spring to ground");
  }
  spring.is_rotation = table.has("torsional_stiffness");
  if (spring.is_rotation) {
    table.refuse_given({"stiffness"}, "expected stiffness or torsional_stiffness, found both");
    spring.stiffness = table.quantity("torsional_stiffness");
  } else if (table.has("stiffness")) {
    spring.stiffness = table.quantity("stiffness");
  } else {
    table.refuse("stiffness", "expected stiffness or torsional_stiffness, found neither");
  }
  table.finish();
  return spring;
}

PointMassSection read_point_mass(const StudyTable& table) {
  PointMassSection mass{table.text("name"), table.text("at"), table.quantity("mass"),
                        Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  if (!(mass.mass_kg >= 0)) table.refuse("mass", "expected a mass of at least 0");
  if (table.has("center")) mass.center_m = quantity_vector(table, "center");
  if (table.has("inertia")) mass.inertia_kg_m2 = read_inertia(table, "inertia");
  table.finish();
  return mass;
}

template <typename Section>
std::vector<Section> read_tables(const StudyTable& modes, const std::string& key,
                                 Section (*read)(const StudyTable&)) {
  std::vector<Section> sections;
  for (const StudyTable& table : modes.tables(key)) sections.push_back(read(table));
  return sections;
}

}  // namespace

std::span<const Key> modes_connection_keys() { return kKeys; }

ModesConnections read_modes_connections(const StudyTable& modes) {
  ModesConnections connections{
      read_tables(modes, "coupling", read_coupling), read_tables(modes, "support", read_support),
      read_tables(modes, "equation", read_equation), read_tables(modes, "spring", read_spring),
      read_tables(modes, "point_mass", read_point_mass)};
  check_names(names_of(connections.couplings), "coupling");
  check_names(names_of(connections.equations), "equation");
  check_names(names_of(connections.springs), "spring");
  check_names(names_of(connections.masses), "point mass");
  return connections;
}

}  // namespace flexneck::pipeline
