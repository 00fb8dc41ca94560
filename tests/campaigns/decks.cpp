// SPDX-License-Identifier: GPL-3.0-or-later
// Abaqus, Nastran, UNV and gmsh decks of random features and spellings, against dense eigenvalues
// of the model they describe; some contain something that must be refused.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include "fe_modal/algebra/petsc_session.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/gmsh/mesh_import.h"
#include "tests/campaigns/campaign.h"
#include "tests/campaigns/deck.h"
#include "tests/campaigns/dense_truth.h"
#include "tests/campaigns/draws.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace {

using namespace flexneck;
using namespace flexneck::campaigns;
using Eigen::Vector3d;
using mesher::ElementKind;

/// Size of the body in lengths of the deck.
constexpr double kSize = 40;

/// The value rounded to the four digits that are written.
double rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  const double digits = std::round(value / unit);
  return std::stod(std::to_string(static_cast<long>(digits)) + "e" +
                   std::to_string(static_cast<int>(std::lround(std::log10(unit)))));
}

double value_between(Case& drawn, double low, double high) {
  return rounded(log_between(drawn, low, high));
}

/// The position rounded to three decimals.
Vector3d place(const Vector3d& at) { return (at * 1000).array().round() / 1000; }

struct Draft {
  Draft(Case& random, bool is_mesh_only, bool is_inp) : drawn(random), is_abaqus(is_inp) {
    add_body();
    add_numbers(is_mesh_only);
    if (is_mesh_only) {
      if (drawn.chance(0.7))
        for (const std::size_t node : deck.bottom) deck.holds.push_back({node, "123"});
      return;
    }
    add_axes();
    add_point();
    add_holds();
    for (int count = drawn.whole(0, 2); count > 0; --count) add_equation();
    if (drawn.chance(0.3)) add_pin();
    for (int count = drawn.whole(0, 3); count > 0; --count) add_spring();
    for (int count = drawn.whole(0, 2); count > 0; --count)
      deck.masses.push_back({any_node(), mass(), Vector3d::Zero(), {}});
  }

  void add_body() {
    static const std::array kKinds = {ElementKind::hex8, ElementKind::hex20, ElementKind::prism6,
                                      ElementKind::prism15, ElementKind::tet10};
    deck.kind = kKinds[static_cast<std::size_t>(drawn.whole(0, 4))];
    deck.length_m = drawn.chance(0.5) ? 1e-3 : log_between(drawn, 1e-3, 1);
    deck.force_N = drawn.chance(0.7) ? 1 : 4.448;
    deck.youngs_modulus = value_between(drawn, 1, 1e6);
    deck.poissons_ratio = rounded(drawn.between(0.05, 0.45));
    deck.density = value_between(drawn, 1e-10, 1e-8);
    const Vector3d shape(drawn.between(0.1, 1), drawn.between(0.2, 1), 1);
    testing::BlockMesh box =
        testing::box({drawn.whole(1, 2), 1, drawn.whole(1, 2)}, {1, 1, 1}, {"stuff", 1, 0.3, 1});
    box.position = [&](const Vector3d& p) {
      return place(kSize * testing::distorted(p).cwiseProduct(shape));
    };
    mesh = testing::with_kind(box.make(), deck.kind);
    mesh.materials[0] = material();
    for (const auto& x : mesh.nodes) deck.places.emplace_back(x.data());
    for (auto& x : mesh.nodes)
      for (double& c : x) c *= deck.length_m;
    const std::size_t n = mesher::nodes_per_element(deck.kind);
    for (const mesher::ElementBlock& block : mesh.blocks)
      for (std::size_t first = 0; first < block.nodes.size(); first += n)
        deck.elements.emplace_back(block.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                                   block.nodes.begin() + static_cast<std::ptrdiff_t>(first + n));
    for (const std::int32_t node : mesh.node_set("bottom").nodes)
      deck.bottom.push_back(static_cast<std::size_t>(node));
    for (const std::int32_t node : mesh.node_set("top").nodes)
      deck.top.push_back(static_cast<std::size_t>(node));
  }

  mesher::Material material() const {
    const double area = deck.length_m * deck.length_m;
    return {"stuff", deck.youngs_modulus * deck.force_N / area, deck.poissons_ratio,
            deck.density * deck.force_N / (area * area)};
  }

  void add_numbers(bool is_mesh_only) {
    if (!is_mesh_only && drawn.chance(0.5)) {
      deck.places.push_back(place(Vector3d(0, 0, kSize) + kSize * direction(drawn)));
      deck.points = 1;
    }
    deck.number_step = drawn.chance(0.5) ? drawn.whole(1, 7) : 0;
    const int first = drawn.whole(1, 5000);
    for (std::size_t k = 0; k < deck.places.size(); ++k)
      deck.numbers.push_back(first +
                             static_cast<int>(k) * (deck.number_step > 0 ? deck.number_step : 3));
    if (deck.number_step == 0) std::shuffle(deck.numbers.begin(), deck.numbers.end(), drawn.random);
    deck.element_numbers.resize(deck.elements.size());
    std::iota(deck.element_numbers.begin(), deck.element_numbers.end(), drawn.whole(1, 100000));
    std::shuffle(deck.element_numbers.begin(), deck.element_numbers.end(), drawn.random);
  }

  std::size_t any_node() {
    return static_cast<std::size_t>(drawn.whole(0, static_cast<int>(deck.nodes()) - 1));
  }
  /// A node that no equation determines yet.
  std::size_t new_node() {
    std::size_t found = any_node();
    for (int tries = 0; tries < 100 && used.contains(found); ++tries) found = any_node();
    used.insert(found);
    return found;
  }
  bool is_turned(std::size_t node) const {
    return std::any_of(deck.axes.begin(), deck.axes.end(), [&](const DeckAxes& axes) {
      return std::find(axes.nodes.begin(), axes.nodes.end(), node) != axes.nodes.end();
    });
  }
  /// A node without axes of its own: Abaqus' springs and pins at others are not read.
  std::size_t plain_node() {
    std::size_t found = any_node();
    while (is_abaqus && is_turned(found)) found = any_node();
    return found;
  }
  double stiffness() {
    return value_between(drawn, 1e-3, 1) *
           std::pow(10, std::round(std::log10(deck.youngs_modulus * kSize)));
  }
  double mass() {
    return value_between(drawn, 1e-2, 1) *
           std::pow(10, std::round(std::log10(deck.density * std::pow(kSize, 3))));
  }

  void add_axes() {
    if (!drawn.chance(0.5)) return;
    DeckAxes axes{drawn.chance(0.5), place(5 * kSize * direction(drawn)), {}, {}, deck.bottom};
    axes.on_z = place(axes.origin + kSize * direction(drawn));
    axes.in_xz = place(axes.origin + kSize * (axes.on_z - axes.origin).unitOrthogonal());
    deck.axes.push_back(axes);
  }

  /// Adds a reference point with a rigid coupling, perhaps with a mass.
  void add_point() {
    if (deck.points == 0) return;
    const std::size_t point = deck.nodes();
    deck.couplings.push_back({point, deck.top, "123456"});
    if (!is_abaqus && drawn.chance(0.3))
      deck.couplings[0].components = drawn.chance(0.5) ? "13" : "2";
    used.insert(deck.top.begin(), deck.top.end());
    if (drawn.chance(0.3)) deck.holds.push_back({point, drawn.chance(0.5) ? "46" : "2"});
    if (!drawn.chance(0.7)) return;
    Deck::Mass body{point, mass(), Vector3d::Zero(), {}};
    if (!is_abaqus) {
      for (double& x : body.center) x = rounded(drawn.between(1, 20));
      const double moment = value_between(drawn, 0.1, 1) *
                            std::pow(10, std::round(std::log10(body.mass * kSize * kSize)));
      body.inertia = {moment, moment * 2, moment * 2, moment / 10, moment / -5, moment / 4};
      for (double& i : body.inertia) i = rounded(i);
    }
    deck.masses.push_back(body);
  }

  void add_holds() {
    const int kind = drawn.whole(0, 4);
    if (kind == 0) return;
    static const std::array kComponents = {"1", "2", "3", "12", "13", "23", "123"};
    for (const std::size_t node : deck.bottom) {
      if (kind == 1 && drawn.chance(0.5)) continue;
      const std::string components =
          kind >= 3 ? "123" : kComponents[static_cast<std::size_t>(drawn.whole(0, 6))];
      deck.holds.push_back({node, components});
      used.insert(node);
    }
  }

  void add_equation() {
    Deck::Equation equation;
    std::set<std::size_t> nodes;
    for (int terms = drawn.whole(2, 5); terms > 0; --terms) {
      const std::size_t node = nodes.empty() ? new_node() : any_node();
      if (!nodes.insert(node).second) continue;
      equation.places.push_back({node, drawn.whole(1, 3)});
      equation.coefficients.push_back((drawn.chance(0.5) ? 1 : -1) * value_between(drawn, 0.1, 10));
    }
    deck.equations.push_back(equation);
  }

  void add_pin() {
    const std::size_t one = plain_node();
    const std::size_t other = plain_node();
    if (one == other || is_turned(one) || is_turned(other) || used.contains(one)) return;
    used.insert(one);
    deck.pins.push_back({{{one, 0}, {other, 0}}, {1, -1}});
  }

  void add_spring() {
    Deck::Spring spring{{plain_node(), drawn.whole(1, 3)},
                        {plain_node(), drawn.whole(1, 3)},
                        drawn.chance(0.5),
                        stiffness()};
    if (spring.one.node == spring.other.node) spring.has_other = false;
    deck.springs.push_back(spring);
  }

  /// A unit displacement of a node's component.
  mesher::Term term(const DeckPlace& at, double coefficient) const {
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    for (const DeckAxes& each : deck.axes)
      if (std::find(each.nodes.begin(), each.nodes.end(), at.node) != each.nodes.end())
        axes = each.at(deck.places[at.node]);
    const Vector3d c = coefficient * axes.col((at.component - 1) % 3);
    const std::size_t n = deck.nodes();
    const std::size_t site = at.node < n ? at.node : n + (at.component > 3 ? 1 : 0);
    return {static_cast<std::int32_t>(site), {c[0], c[1], c[2]}};
  }

  /// The mesh with all content of the deck as equations.
  mesher::Mesh meant() const {
    mesher::Mesh result = mesh;
    mesher::Connections& all = result.connections;
    const double length = deck.length_m;
    for (std::size_t k = deck.nodes(); k < deck.places.size(); ++k) {
      const Vector3d x = length * deck.places[k];
      all.points.push_back({"point", {x[0], x[1], x[2]}});
    }
    for (const Deck::Hold& hold : deck.holds)
      for (const char component : hold.components)
        all.equations.push_back({"hold", {term({hold.node, component - '0'}, 1)}});
    for (const Deck::Equation& equation : deck.equations) {
      all.equations.push_back({"equation", {}});
      for (std::size_t k = 0; k < equation.places.size(); ++k)
        all.equations.back().terms.push_back(term(equation.places[k], equation.coefficients[k]));
    }
    for (const Deck::Equation& pin : deck.pins)
      for (int component = 1; component <= 3; ++component)
        all.equations.push_back({"pin",
                                 {term({pin.places[0].node, component}, 1),
                                  term({pin.places[1].node, component}, -1)}});
    for (const Deck::Spring& spring : deck.springs) {
      all.springs.push_back(
          {"spring", {term(spring.one, 1)}, spring.stiffness * deck.force_N / length});
      if (spring.has_other) all.springs.back().terms.push_back(term(spring.other, -1));
    }
    for (const Deck::Mass& mass : deck.masses) {
      const double kg = deck.force_N / length;
      mesher::PointMass point{"mass", static_cast<std::int32_t>(mass.node), mass.mass * kg, {}, {}};
      for (std::size_t k = 0; k < 3; ++k)
        point.center_m[k] = length * mass.center[static_cast<Eigen::Index>(k)];
      for (std::size_t k = 0; k < 6; ++k)
        point.inertia_kg_m2[k] = mass.inertia[k] * kg * length * length;
      all.masses.push_back(point);
    }
    for (const Deck::Coupling& coupling : deck.couplings) {
      mesher::Coupling rigid{"coupling", 0, {}, {false, false, false}};
      for (const char component : coupling.components)
        if (component <= '3') rigid.directions[static_cast<std::size_t>(component - '1')] = true;
      for (const std::size_t node : coupling.nodes)
        rigid.nodes.push_back(static_cast<std::int32_t>(node));
      all.couplings.push_back(rigid);
    }
    return result;
  }

  Case& drawn;
  bool is_abaqus;
  Deck deck;
  mesher::Mesh mesh;
  std::set<std::size_t> used;
};

std::optional<std::string> judge(Case& drawn) {
  const double format = drawn.between(0, 1);
  const bool is_inp = format < 0.4;
  const bool is_mesh_only = format > 0.8;
  const char* const name = is_inp         ? "deck.inp"
                           : format < 0.8 ? "deck.bdf"
                           : format < 0.9 ? "deck.unv"
                                          : "deck.msh";
  const auto write = is_inp         ? write_inp
                     : format < 0.8 ? write_bdf
                     : format < 0.9 ? write_unv
                                    : write_msh;
  const Draft draft(drawn, is_mesh_only, is_inp);
  const std::filesystem::path folder =
      std::filesystem::path(drawn.folder) / ("case" + std::to_string(drawn.number));
  std::filesystem::create_directories(folder);
  const std::string wrong = write(drawn, draft.deck, folder / name, drawn.chance(0.15));
  mesher::ImportOptions options;
  options.file = folder / name;
  options.length_unit_m = draft.deck.length_m;
  options.force_unit_N = draft.deck.force_N;
  if (!is_inp) {
    options.materials = {draft.material()};
    options.material_of_part[format > 0.9 ? "solid" : "volume_1"] = "stuff";
  }
  std::optional<std::string> found;
  try {
    mesher::Mesh given = mesher::import_mesh(options, {});
    if (!wrong.empty()) return std::string(name) + " was read with '" + wrong + "' in it";
    if (is_mesh_only && !draft.deck.holds.empty())
      given.connections.supports.push_back({"hold", given.node_set("bottom").nodes});
    found = compare_modes(drawn, given, draft.meant(), kSize * draft.deck.length_m);
  } catch (const InputError& error) {
    if (wrong.empty()) return std::string("was refused: ") + error.what();
    drawn.was_refused = true;
  }
  if (found) return std::string(name) + ": " + *found;
  std::filesystem::remove_all(folder);
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  const fe_modal::PetscSession session;
  return run(argc, argv, judge);
}
