// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "geometry/neck/neck_measures.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::mesher {
namespace {

using geometry::NeckDivisions;
using testing::neck_parameters;

/// Relative error of a sector's area with second-order elements of 30 degrees, as in
/// test_neck_mesh.cpp.
constexpr double kParabola = 1.6e-4;

Mesh neck_of(const std::string& set, const NeckDivisions& divisions, ElementKind element) {
  ScriptMeshOptions options = testing::neck_mesh_options(neck_parameters(set), divisions);
  options.element = element;
  if (element == ElementKind::tet10) options.constants["recombine"] = 0;
  options.patches.clear();  // 8-node elements need not have a node near every bolt
  return mesh_script(options, {});
}

std::map<std::string, double> densities(const Mesh& mesh) {
  std::map<std::string, double> density;
  for (const ElementBlock& block : mesh.blocks) {
    density[block.part] = mesh.materials[block.material].density_kg_m3;
  }
  return density;
}

geometry::NeckMeasures exact_measures(const std::string& set, const Mesh& mesh) {
  return geometry::measure(neck_parameters(set), densities(mesh));
}

struct RigidBody {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< int x x^T dm about the centre
};

RigidBody integrated(const Mesh& mesh) {
  RigidBody body;
  for (const ElementBlock& block : mesh.blocks) {
    const double density = mesh.materials[block.material].density_kg_m3;
    const Quadrature rule = gauss_rule(block.kind, 4);
    const ShapeTable table = tabulate(block.kind, rule.points);
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const Eigen::Matrix3Xd x = positions_of(mesh, std::span(block.nodes).subspan(n * e, n));
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        Eigen::Matrix3d jacobian;
        for (std::size_t d = 0; d < 3; ++d) {
          jacobian.col(static_cast<Eigen::Index>(d)) = x * table.derivatives[d].col(q);
        }
        const double mass = density * rule.weights[q] * jacobian.determinant();
        const Eigen::Vector3d at = x * table.values.col(q);
        body.mass += mass;
        body.centre += mass * at;
        body.second += mass * at * at.transpose();
      }
    }
  }
  body.centre /= body.mass;
  body.second -= body.mass * body.centre * body.centre.transpose();
  return body;
}

double volume_error(const Mesh& mesh) {
  return std::abs(summarise(mesh).volume_m3 / exact_measures("C", mesh).volume_m3 - 1);
}

}  // namespace

TEST_CASE("mass, centre of gravity and inertia in closed form are those of the mesh") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    INFO("set " << set);
    const Mesh mesh = neck_of(set, {.quadrant = 8}, ElementKind::hex27);
    const RigidBody body = integrated(mesh);
    const geometry::NeckMeasures exact = exact_measures(set, mesh);
    constexpr double kClose = 3e-5;  // 1/16 of the error of second moments at 30 degrees
    const Eigen::Matrix3d& s = body.second;
    const double length = neck_parameters(set).length;
    CHECK(exact.mass_kg == Approx(body.mass).epsilon(kClose));
    CHECK(exact.centre_m[0] == Approx(body.centre[0]).margin(kClose * length));
    CHECK(std::abs(body.centre[1]) < 1e-10);
    CHECK(exact.centre_m[2] == Approx(body.centre[2]).epsilon(kClose));
    CHECK(exact.inertia_kg_m2[0] == Approx(s(1, 1) + s(2, 2)).epsilon(kClose));
    CHECK(exact.inertia_kg_m2[1] == Approx(s(0, 0) + s(2, 2)).epsilon(kClose));
    CHECK(exact.inertia_kg_m2[2] == Approx(s(0, 0) + s(1, 1)).epsilon(kClose));
    CHECK(exact.product_xz_kg_m2 == Approx(s(0, 2)).margin(kClose * exact.inertia_kg_m2[2]));
  }
}

TEST_CASE("the paper's density: 2400 elements, with 8 nodes each 3408 nodes") {
  const NeckDivisions paper = geometry::divisions_preset("paper");
  const Mesh mesh = neck_of("A", paper, ElementKind::hex8);
  const MeshSummary summary = summarise(mesh);
  CHECK(summary.elements == 2400);  // the paper: 2386
  CHECK(summary.nodes == 3408);     // the paper: 3427
  CHECK(summary.smallest_scaled_jacobian > 0.7);
  CHECK(geometry::hexahedra(paper) == 2400);
}

TEST_CASE("a refined mesh has all corners of the coarser one, gradings and all") {
  NeckDivisions divisions{.outer_ring = 2};
  const Mesh coarse = neck_of("C", divisions, ElementKind::hex8);
  for (const int refine : {1, 2}) {
    INFO("refine " << refine);
    divisions.refine = refine;
    const Mesh fine = neck_of("C", divisions, ElementKind::hex8);
    CHECK(summarise(fine).elements == static_cast<std::size_t>(geometry::hexahedra(divisions)));
    std::set<std::array<long, 3>> places;
    constexpr double kPlace_m = 1e-6;
    const auto place = [&](const std::array<double, 3>& x, long i, long j, long k) {
      return std::array{std::lround(x[0] / kPlace_m) + i, std::lround(x[1] / kPlace_m) + j,
                        std::lround(x[2] / kPlace_m) + k};
    };
    for (const auto& x : fine.nodes) {
      for (const long i : {-1, 0, 1}) {
        for (const long j : {-1, 0, 1}) {
          for (const long k : {-1, 0, 1}) places.insert(place(x, i, j, k));
        }
      }
    }
    for (const auto& x : coarse.nodes) CHECK(places.count(place(x, 0, 0, 0)) == 1);
  }
}

TEST_CASE("volumes converge at the order of the elements, from less than 1e-3 at the default on") {
  struct Expected {
    ElementKind kind;
    double order;
    double largest_error;
  };
  // 8-node elements make a polygon of every circle. The next term in the series of the error
  // changes the ratio by a few per cent.
  for (const auto& [kind, order, largest] : {Expected{ElementKind::hex27, 4, kParabola},
                                             {ElementKind::hex20, 4, kParabola},
                                             {ElementKind::tet10, 4, kParabola},
                                             {ElementKind::hex8, 2, 0.04}}) {
    INFO(name_of(kind));
    const double coarse = volume_error(neck_of("C", {}, kind));
    const double fine = volume_error(neck_of("C", {.refine = 1}, kind));
    CHECK(coarse < largest);
    CHECK(coarse / fine == Approx(std::pow(2, order)).epsilon(0.03));
  }
}

TEST_CASE("each neck can be meshed with each kind of element") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    for (const ElementKind kind : {ElementKind::hex27, ElementKind::hex8, ElementKind::tet10}) {
      INFO("set " << set << ", " << name_of(kind));
      const Mesh mesh = neck_of(set, {}, kind);
      CHECK(mesh.blocks.size() == 9);
      for (const ElementBlock& block : mesh.blocks) CHECK(block.kind == kind);
      CHECK(summarise(mesh).smallest_scaled_jacobian > 0.02);
    }
  }
}

}  // namespace flexneck::mesher
