// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/body/static_solution_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/boundary.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

/// Relative error of solutions that the elements represent exactly: rounding of a direct solution
/// alone.
constexpr double kExact = 1e-9;
constexpr double kYoung = 2e9;
constexpr double kWidth = 0.04, kDepth = 0.06, kHeight = 0.2;

/// A block without lateral contraction, so that a clamp adds no stiffness.
mesher::Mesh block(mesher::ElementKind kind, double poissons_ratio = 0) {
  return testing::with_kind(
      testing::box({2, 1, 3}, {kWidth, kDepth, kHeight}, {"plain", kYoung, poissons_ratio, 1500})
          .make(),
      kind);
}

std::vector<std::int32_t> nodes_where(const mesher::Mesh& mesh,
                                      const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  std::vector<std::int32_t> nodes;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    if (wanted(Eigen::Map<const Eigen::Vector3d>(mesh.nodes[k].data())))
      nodes.push_back(static_cast<std::int32_t>(k));
  }
  return nodes;
}

/// Largest difference of the stresses from those of a field, relative to `scale_Pa`.
template <typename Field>
double stress_error(const StaticSolution& solution, double scale_Pa, const Field& field) {
  double largest_Pa = 0;
  for (const PointStresses& each : solution.at_points) {
    for (Eigen::Index k = 0; k < each.stress_Pa.cols(); ++k) {
      const Stress expected = field(Eigen::Vector3d(each.positions_m.col(k)));
      largest_Pa = std::max(largest_Pa, (each.stress_Pa.col(k) - expected).cwiseAbs().maxCoeff());
    }
  }
  for (const NodalStresses& each : solution.at_nodes) {
    for (Eigen::Index k = 0; k < each.stress_Pa.cols(); ++k) {
      const Stress expected =
          field(Eigen::Vector3d(solution.nodes_m.col(each.nodes[static_cast<std::size_t>(k)])));
      largest_Pa = std::max(largest_Pa, (each.stress_Pa.col(k) - expected).cwiseAbs().maxCoeff());
    }
  }
  return largest_Pa / scale_Pa;
}

Stress along_z(double stress_Pa) {
  Stress stress = Stress::Zero();
  stress[2] = stress_Pa;
  return stress;
}

ModalOptions clamped(Formulation formulation = Formulation::displacement) {
  ModalOptions options;
  options.formulation.of_others = formulation;
  options.fixed_set = "bottom";
  return options;
}

/// A cube with curved edges and faces, but undisplaced corners.
mesher::Mesh bent_cube(mesher::ElementKind kind) {
  testing::BlockMesh block = testing::box({2, 2, 2}, {1, 1, 1}, {"rubber", 8e6, 0.45, 1000});
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const auto bump = [](double t) { return std::sin(std::numbers::pi * t); };
    return p + 0.06 * Eigen::Vector3d(bump(p.y()) * p.z(), bump(p.z()) + bump(p.x()) * p.y(),
                                      bump(p.x()) - bump(p.y()));
  };
  mesher::Mesh mesh = testing::with_kind(block.make(), kind);
  mesh.face_sets.push_back(mesher::faces_among(mesher::boundary_facets(mesh), "all round",
                                               [](std::int32_t) { return true; }));
  const auto corner = [&](const std::string& name, const Eigen::Vector3d& at) {
    mesh.node_sets.push_back(
        {name, nodes_where(mesh, [&](const auto& p) { return (p - at).norm() < 1e-9; })});
    REQUIRE(mesh.node_sets.back().nodes.size() == 1);
  };
  corner("origin", {0, 0, 0});
  corner("on x", {1, 0, 0});
  corner("on y", {0, 1, 0});
  return mesh;
}

}  // namespace

TEST_CASE("pressure all round a bent cube is the pressure at every point of any elements") {
  const mesher::ElementKind kind = GENERATE(from_range(kVolumes));
  const Formulation formulation = GENERATE(from_range(kFull));
  if (!offered(kind, formulation)) return;
  CAPTURE(mesher::name_of(kind), name_of(formulation));
  const mesher::Mesh mesh = bent_cube(kind);
  ModalOptions options;
  options.mode_count = 1;
  options.formulation.of_others = formulation;
  options.fixed_set = "origin";
  options.fixed_directions = {{"on x", {false, true, true}}, {"on y", {false, false, true}}};
  constexpr double kPressure = 3e3;
  const StaticSolution solution =
      analyse_static(mesh, options, {{"sea", PressureLoad{"all round", kPressure}}}, {});
  Stress expected = Stress::Zero();
  expected.head<3>().setConstant(-kPressure);
  CHECK(stress_error(solution, kPressure, [&](const Eigen::Vector3d&) { return expected; }) < 1e-7);
  // The displacement is u = -p / (3 kappa) x about the fixed corner.
  const double bulk_modulus = 8e6 / (3 * (1 - 2 * 0.45));
  const Eigen::Matrix3Xd displacements =
      -kPressure / (3 * bulk_modulus) *
      (solution.nodes_m.colwise() -
       solution.nodes_m.col(mesh.node_set("origin").nodes.front()).eval());
  CHECK((solution.displacements_m - displacements).norm() < 1e-7 * displacements.norm());
  CHECK(solution.reactions_N.norm() < 1e-7 * solution.applied_N.norm());
}

TEST_CASE("supports that move stretch a bar by the closed form, of any elements") {
  const mesher::ElementKind kind = GENERATE(from_range(kVolumes));
  const Formulation formulation = GENERATE(from_range(kFormulations));
  if (!offered(kind, formulation)) return;
  CAPTURE(mesher::name_of(kind), name_of(formulation));
  mesher::Mesh mesh = block(kind);
  ModalOptions options = clamped(formulation);
  mesher::NodeSet ends{"ends", mesh.node_set("bottom").nodes};
  const std::vector<std::int32_t> top = mesh.node_set("top").nodes;
  ends.nodes.insert(ends.nodes.end(), top.begin(), top.end());
  std::sort(ends.nodes.begin(), ends.nodes.end());
  mesh.node_sets.push_back(ends);
  options.fixed_set = "ends";
  constexpr double kStretch = 1e-3;
  SupportLoad support{"top"};
  support.translation_m = {0, 0, kStretch * kHeight};
  const StaticSolution solution = analyse_static(mesh, options, {{"stretch", support}}, {});
  const double stress_Pa = kYoung * kStretch;
  CHECK(stress_error(solution, stress_Pa,
                     [&](const Eigen::Vector3d&) { return along_z(stress_Pa); }) < kExact);
  Eigen::Matrix3Xd at_top = solution.reactions_N(Eigen::all, top);
  CHECK(at_top.row(2).sum() == Approx(stress_Pa * kWidth * kDepth).epsilon(kExact));
  CHECK(resultant_of(solution.nodes_m, solution.reactions_N).force_N.norm() <
        kExact * stress_Pa * kWidth * kDepth);
}

TEST_CASE("a bar bent by a moment on a face or by its supports has the stresses M x / I") {
  const mesher::ElementKind kind = GENERATE(mesher::ElementKind::hex20, mesher::ElementKind::hex27);
  const Formulation formulation = GENERATE(from_range(kFormulations));
  if (!offered(kind, formulation)) return;
  CAPTURE(mesher::name_of(kind), name_of(formulation));
  const mesher::Mesh mesh = block(kind);
  constexpr double kMoment = 4.0;
  const double inertia = kDepth * std::pow(kWidth, 3) / 12;
  const auto bending = [&](const Eigen::Vector3d& p) {
    return along_z(-kMoment * p.x() / inertia);
  };
  const double scale = kMoment * kWidth / 2 / inertia;
  FaceLoad face{"top"};
  face.moment_Nm = {0, kMoment, 0};
  const StaticSolution by_face = analyse_static(mesh, clamped(formulation), {{"moment", face}}, {});
  CHECK(stress_error(by_face, scale, bending) < kExact);
  const Resultant reaction = resultant_of(by_face.nodes_m, by_face.reactions_N);
  CHECK((reaction.moment_Nm + face.moment_Nm).norm() < kExact * kMoment);
  // A rotation of the top, which may slide in its plane, gives the same result.
  ModalOptions options = clamped(formulation);
  options.fixed_directions = {{"top", {false, false, true}}};
  SupportLoad support{"top"};
  support.rotation_rad = {0, kMoment * kHeight / (kYoung * inertia), 0};
  const StaticSolution by_support = analyse_static(mesh, options, {{"turn", support}}, {});
  CHECK(stress_error(by_support, scale, bending) < kExact);
  CHECK((by_support.displacements_m - by_face.displacements_m).norm() <
        kExact * by_face.displacements_m.norm());
}

TEST_CASE("a standing bar carries its weight, and a force at a node has its reaction") {
  const mesher::Mesh mesh = block(mesher::ElementKind::hex20);
  const Eigen::Vector3d gravity(0.5, 0, -9.81);
  const double mass = 1500 * kWidth * kDepth * kHeight;
  const Eigen::Vector3d corner(kWidth / 2, -kDepth / 2, kHeight);
  const Eigen::Vector3d pull(3, -2, 7);
  const std::vector<Load> loads = {{"weight", GravityLoad{gravity}},
                                   {"pull", NodeLoad{"", corner, pull}}};
  const StaticSolution solution = analyse_static(mesh, clamped(), loads, {});
  const Resultant reaction = resultant_of(solution.nodes_m, solution.reactions_N);
  CHECK((reaction.force_N + mass * gravity + pull).norm() < kExact * mass * 9.81);
  const Eigen::Vector3d moment =
      Eigen::Vector3d(0, 0, kHeight / 2).cross(mass * gravity) + corner.cross(pull);
  CHECK((reaction.moment_Nm + moment).norm() < kExact * moment.norm());
  // Under its own weight each section carries the weight above it.
  const StaticSolution standing =
      analyse_static(mesh, clamped(), {{"weight", GravityLoad{{0, 0, -9.81}}}}, {});
  CHECK(stress_error(standing, 1500 * 9.81 * kHeight, [](const Eigen::Vector3d& p) {
          return along_z(-1500 * 9.81 * (kHeight - p.z()));
        }) < kExact);
}

TEST_CASE("a static solution is the same after it was written and read") {
  const TemporaryFolder folder;
  const mesher::Mesh mesh = block(mesher::ElementKind::hex20);
  StaticSolutionFile file;
  file.solution = analyse_static(mesh, clamped(), {{"weight", GravityLoad{{0, 0, -9.81}}}}, {});
  write_static_solution(folder / "stress.h5", file);
  const StaticSolution read = read_static_solution(folder / "stress.h5").solution;
  CHECK(read.boundary == "fixed: bottom");
  CHECK(read.loads == std::vector<std::string>{"weight: gravity (0, 0, -9.81) m/s^2"});
  CHECK(read.displacements_m == file.solution.displacements_m);
  CHECK(read.reactions_N == file.solution.reactions_N);
  REQUIRE(read.at_nodes.size() == 1);
  CHECK(read.at_nodes[0].stress_Pa == file.solution.at_nodes[0].stress_Pa);
  REQUIRE(read.at_points.size() == 1);
  CHECK(read.at_points[0].points_per_element == 27);
  CHECK(read.at_points[0].stress_Pa == file.solution.at_points[0].stress_Pa);
  file.solution.reactions_N *= 1.001;
  write_static_solution(folder / "wrong.h5", file);
  CHECK_THROWS_WITH(read_static_solution(folder / "wrong.h5"), Contains("not in equilibrium"));
}

TEST_CASE("loads that fit neither mesh nor supports are refused by their names") {
  mesher::Mesh mesh = block(mesher::ElementKind::hex20);
  const auto refused = [&](const ModalOptions& options, const Load& load, const char* reason) {
    CHECK_THROWS_WITH(analyse_static(mesh, options, {load}, {}), Contains(reason));
  };
  ModalOptions free;
  refused(free, {"weight", GravityLoad{{0, 0, -1}}}, "needs supports");
  refused(clamped(), {"pull", NodeLoad{"", Eigen::Vector3d(0, 0, 1), {1, 0, 0}}},
          "load 'pull': there is no node at (0, 0, 1) m; the nearest is at (0, 0, 0.2) m");
  refused(clamped(), {"push", PressureLoad{"side", 1}}, "load 'push'");
  refused(clamped(), {"shift", SupportLoad{"top", {1, 0, 0}}}, "has nodes that are not fixed");
  ModalOptions rollers = clamped();
  rollers.fixed_directions = {{"top", {false, false, true}}};
  refused(rollers, {"shift", SupportLoad{"top", {1e-3, 0, 0}}}, "is not fixed in x");
  ModalOptions hinge = clamped();
  hinge.fixed_set.clear();
  hinge.fixed_directions = {{"bottom", {true, true, false}}};
  refused(hinge, {"weight", GravityLoad{{0, 0, -1}}},
          "the body slides along z, rotates about x and y");
}

}  // namespace flexneck::fe_modal
