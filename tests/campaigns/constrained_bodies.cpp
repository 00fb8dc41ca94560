// SPDX-License-Identifier: GPL-3.0-or-later
// Small bodies of random size, place and kind of element under random supports, equations,
// couplings, springs and masses, against dense eigenvalues in the null space of all equations.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "fe_modal/algebra/petsc_session.h"
#include "tests/campaigns/campaign.h"
#include "tests/campaigns/dense_truth.h"
#include "tests/campaigns/draws.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace {

using namespace flexneck;
using campaigns::Case;
using campaigns::direction;
using campaigns::log_between;
using Eigen::Vector3d;

std::array<bool, 3> some_directions(Case& drawn) {
  std::array<bool, 3> some = {drawn.chance(0.6), drawn.chance(0.6), drawn.chance(0.6)};
  if (!some[0] && !some[1] && !some[2]) some[static_cast<std::size_t>(drawn.whole(0, 2))] = true;
  return some;
}

/// A block of up to four hexahedra, or elements cut from them, of random size and position.
struct Body {
  explicit Body(Case& drawn) : drawn_(drawn) {
    size_m = log_between(drawn, 1e-3, 10);
    place_m = size_m * (drawn.chance(0.3) ? 0 : log_between(drawn, 1, 1e4)) * direction(drawn);
    const Vector3d shape(drawn.between(0.1, 1), drawn.between(0.2, 1), 1);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(drawn.between(0, 3), direction(drawn)).toRotationMatrix();
    const mesher::Material material{"solid", log_between(drawn, 1e6, 3e11), drawn.between(0, 0.45),
                                    log_between(drawn, 500, 8000)};
    testing::BlockMesh box =
        testing::box({drawn.whole(1, 2), 1, drawn.whole(1, 2)}, {1, 1, 1}, material);
    box.position = [&](const Vector3d& p) -> Vector3d {
      return place_m + size_m * (turn * testing::distorted(p).cwiseProduct(shape));
    };
    const std::vector<mesher::ElementKind> kinds = {
        mesher::ElementKind::hex8,   mesher::ElementKind::hex20,   mesher::ElementKind::hex27,
        mesher::ElementKind::prism6, mesher::ElementKind::prism15, mesher::ElementKind::prism18,
        mesher::ElementKind::tet10};
    const auto last = static_cast<int>(kinds.size()) - 1;
    mesh = testing::with_kind(box.make(), kinds[static_cast<std::size_t>(drawn.whole(0, last))]);
    stiffness = material.youngs_modulus_Pa * size_m;
    mass_kg = material.density_kg_m3 * std::pow(size_m, 3);
  }

  std::int32_t node() { return drawn_.whole(0, static_cast<int>(mesh.nodes.size()) - 1); }
  /// A node that no equation determines yet.
  std::int32_t new_node() {
    std::int32_t found = node();
    for (int tries = 0; tries < 100 && used.contains(found); ++tries) found = node();
    used.insert(found);
    return found;
  }
  const std::vector<std::int32_t>& set(const std::string& name) const {
    return mesh.node_set(name).nodes;
  }

  mesher::Mesh mesh;
  Vector3d place_m;
  double size_m = 1;
  double stiffness = 1;  ///< N/m
  double mass_kg = 1;
  std::set<std::int32_t> used;

 private:
  Case& drawn_;
};

void add_supports(Case& drawn, Body& body) {
  const int kind = drawn.whole(0, 4);
  if (kind == 0) return;  // free
  mesher::Support support{"support", body.set("bottom"), some_directions(drawn)};
  if (kind == 1) support.nodes.resize(static_cast<std::size_t>(drawn.whole(1, 3)));
  if (kind >= 3) {
    support.axes.axes = mesher::axes_from(direction(drawn), Vector3d::Zero());
    support.axes.is_cylindrical = kind == 4;
    support.axes.origin_m = body.place_m + 2 * body.size_m * direction(drawn);
  }
  body.used.insert(support.nodes.begin(), support.nodes.end());
  body.mesh.connections.supports.push_back(std::move(support));
}

/// A rigid coupling of the upper face or some of its nodes, perhaps with a mass.
void add_coupling(Case& drawn, Body& body) {
  if (!drawn.chance(0.5)) return;
  mesher::Connections& connections = body.mesh.connections;
  const Vector3d at = body.place_m + body.size_m * drawn.between(0, 3) * direction(drawn);
  connections.points = {{"point", {at[0], at[1], at[2]}}};
  mesher::Coupling coupling{"coupling", 0, body.set("top")};
  if (drawn.chance(0.3)) coupling.directions = some_directions(drawn);
  body.used.insert(coupling.nodes.begin(), coupling.nodes.end());
  connections.couplings.push_back(std::move(coupling));
  if (!drawn.chance(0.7)) return;
  const double mass_kg = body.mass_kg * log_between(drawn, 1e-2, 10);
  const double inertia = mass_kg * body.size_m * body.size_m * drawn.between(0.01, 1);
  const Vector3d center = body.size_m * drawn.between(0, 1) * direction(drawn);
  connections.masses.push_back({"mass",
                                mesher::translation_site(body.mesh.nodes.size(), 0),
                                mass_kg,
                                {center[0], center[1], center[2]},
                                {inertia, 1.2 * inertia, 0.9 * inertia, 0, 0, 0}});
}

/// Equations by which the upper face's nodes move as those below them, in all directions.
void add_periodic(Body& body) {
  const std::vector<std::int32_t>& lower = body.set("bottom");
  const std::vector<std::int32_t>& upper = body.set("top");
  for (std::size_t k = 0; k < std::min(lower.size(), upper.size()); ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      mesher::Equation equation{"periodic", {{upper[k], {}}, {lower[k], {}}}};
      equation.terms[0].coefficients[a] = 1;
      equation.terms[1].coefficients[a] = -1;
      body.mesh.connections.equations.push_back(equation);
    }
  }
  body.used.insert(upper.begin(), upper.end());
}

void add_equations(Case& drawn, Body& body) {
  mesher::Connections& connections = body.mesh.connections;
  if (connections.couplings.empty() && drawn.chance(0.2)) add_periodic(body);
  for (int k = drawn.whole(0, 3); k > 0; --k) {
    mesher::Equation equation{"equation " + std::to_string(k), {}};
    for (int terms = drawn.whole(2, 4); terms > 0; --terms) {
      const Vector3d c = direction(drawn) * log_between(drawn, 1e-3, 1e3);
      const std::int32_t site = equation.terms.empty() ? body.new_node() : body.node();
      const auto is_site = [&](const mesher::Term& term) { return term.site == site; };
      if (std::any_of(equation.terms.begin(), equation.terms.end(), is_site)) continue;
      equation.terms.push_back({site, {c[0], c[1], c[2]}});
    }
    connections.equations.push_back(std::move(equation));
  }
}

void add_springs_and_masses(Case& drawn, Body& body) {
  mesher::Connections& connections = body.mesh.connections;
  for (int k = drawn.whole(0, 3); k > 0; --k) {
    const Vector3d along = direction(drawn);
    mesher::Spring spring{"spring",
                          {{body.node(), {along[0], along[1], along[2]}}},
                          body.stiffness * log_between(drawn, 1e-4, 1)};
    const std::int32_t other = body.node();
    if (drawn.chance(0.5) && other != spring.terms[0].site)
      spring.terms.push_back({other, {-along[0], -along[1], -along[2]}});
    connections.springs.push_back(std::move(spring));
  }
  if (drawn.chance(0.3))
    connections.masses.push_back(
        {"at a node", body.node(), body.mass_kg * log_between(drawn, 1e-2, 10), {}, {}});
}

std::optional<std::string> judge(Case& drawn) {
  Body body(drawn);
  add_supports(drawn, body);
  add_coupling(drawn, body);
  add_equations(drawn, body);
  add_springs_and_masses(drawn, body);
  return campaigns::compare_modes(drawn, body.mesh, body.mesh, body.size_m);
}

}  // namespace

int main(int argc, char** argv) {
  const fe_modal::PetscSession session;
  return campaigns::run(argc, argv, judge);
}
