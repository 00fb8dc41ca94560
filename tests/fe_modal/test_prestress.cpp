// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/prestress.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

// The model is half of a column, pinned at the top, with its plane of symmetry at the bottom;
// without lateral contraction the stress is uniform.
constexpr double kYoung = 7e10;
constexpr double kDensity = 2700;
constexpr double kLength = 1.0;  ///< length of the whole column
constexpr double kThickness = 0.01;
constexpr double kDepth = 0.03;
/// Relative effect of shear and rotary inertia: (pi h / L)^2 / 12 times a factor of the order of
/// one.
constexpr double kSlender = 4e-4;

mesher::Mesh half_column() {
  mesher::Mesh mesh = testing::with_kind(
      testing::box({1, 1, 20}, {kThickness, kDepth, kLength / 2}, {"light", kYoung, 0, kDensity})
          .make(),
      mesher::ElementKind::hex20);
  mesher::NodeSet all{"all", {}};
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    all.nodes.push_back(static_cast<std::int32_t>(k));
  mesh.node_sets.push_back(all);
  return mesh;
}

/// Options of the column under an axial force.
/// @param force_N tension positive
ModalOptions column_under(double force_N) {
  ModalOptions options;
  options.mode_count = 2;
  options.formulation.of_others = Formulation::displacement;
  options.fixed_directions = {{"bottom", {false, false, true}},
                              {"top", {true, false, false}},
                              {"all", {false, true, false}}};
  if (force_N != 0) {
    FaceLoad face{"top"};
    face.force_N = {0, 0, force_N};
    options.prestress = {{"force", face}};
  }
  return options;
}

double euler_load() {
  return std::pow(std::numbers::pi / kLength, 2) * kYoung * kDepth * std::pow(kThickness, 3) / 12;
}

double first_Hz(const mesher::Mesh& mesh, const ModalOptions& options) {
  return analyse_modes(mesh, options, {}).frequencies_Hz[0];
}

}  // namespace

TEST_CASE(
    "a column's frequency falls to zero at Euler's load, and under tension it is a string's") {
  const mesher::Mesh mesh = half_column();
  const double unloaded = first_Hz(mesh, column_under(0));
  const double beam = std::numbers::pi / 2 *
                      std::sqrt(kYoung * kThickness * kThickness / 12 / kDensity) /
                      (kLength * kLength);
  CHECK(unloaded == Approx(beam).epsilon(kSlender));
  const double euler = euler_load();
  Model pushed(mesh, column_under(-euler));
  add_prestress(pushed, {});
  const auto factor = buckling_factor(pushed);
  REQUIRE(factor);
  CHECK(*factor == Approx(1).epsilon(kSlender));
  // In f = f0 sqrt(1 - P / Pcr) both f0 and Pcr are for the same half wave.
  const double critical = *factor * euler;
  for (const double share : {-100.0, -1.0, 0.5, 0.99}) {
    CAPTURE(share);
    CHECK(first_Hz(mesh, column_under(-share * critical)) ==
          Approx(unloaded * std::sqrt(1 - share)).epsilon(kSlender));
  }
  const double tension = 1000 * euler;
  const double string = std::sqrt(tension / (kDensity * kThickness * kDepth)) / (2 * kLength);
  CHECK(first_Hz(mesh, column_under(tension)) ==
        Approx(string * std::sqrt(1 + 1e-3)).epsilon(2 * kSlender));
  Model pulled(mesh, column_under(euler));
  add_prestress(pulled, {});
  CHECK_FALSE(buckling_factor(pulled));
  CHECK_THROWS_WITH(first_Hz(mesh, column_under(-1.25 * critical)),
                    Contains("buckles under its prestress at 0.8 times the loads"));
}

TEST_CASE("a prestress beyond small displacements is told with its strain") {
  const mesher::Mesh mesh = half_column();
  const auto told = [&](double force_N) {
    std::string text;
    analyse_modes(mesh, column_under(force_N), {}, nullptr,
                  [&](const std::string& warning) { text += warning; });
    return text;
  };
  const double area = kThickness * kDepth;
  CHECK(told(0.05 * kYoung * area).empty());
  CHECK_THAT(told(0.6 * kYoung * area),
             Contains("static step of the prestress causes strains of up to 0.6") &&
                 Contains("reduce the loads"));
}

TEST_CASE("a prestressed body is solved for by MUMPS and refined for the error of its mesh, too") {
  const mesher::Mesh mesh = half_column();
  ModalOptions options;
  options.mode_count = 2;
  options.formulation.of_others = Formulation::displacement;
  options.fixed_set = "bottom";
  FaceLoad face{"top"};
  face.force_N = {0, 0, 2 * euler_load()};
  options.prestress = {{"pull", face}};
  const ModalBody direct = analyse_modes(mesh, options, {});
  CHECK(direct.prestress == "pull: face 'top', force (0, 0, " + std::string() +
                                direct.prestress.substr(direct.prestress.find("0, 0, ") + 6));
  CHECK_THAT(direct.boundary, Contains("fixed: bottom; prestressed"));
  ModalOptions by_mumps = options;
  by_mumps.solver = Solver::mumps;
  const ModalBody other = analyse_modes(mesh, by_mumps, {});
  CHECK((other.frequencies_Hz - direct.frequencies_Hz).norm() <
        1e-8 * direct.frequencies_Hz.norm());
  ModalOptions checked = options;
  checked.check = true;
  const ModalBody refined = analyse_modes(mesh, checked, {});
  REQUIRE(refined.modes[0].mesh_error);
  // Without the prestress on the finer mesh the change would be of the order of one.
  CHECK(refined.modes[0].mesh_error->error < 0.02);
  FaceLoad push{"top"};
  push.force_N = {0, 0, -20 * euler_load()};
  by_mumps.prestress = {{"push", push}};
  CHECK_THROWS_WITH(analyse_modes(mesh, by_mumps, {}), Contains("buckles under its prestress"));
}

TEST_CASE("what a prestress does not go with is refused") {
  const mesher::Mesh mesh = half_column();
  const auto refused = [&](ModalOptions options, const char* reason) {
    CHECK_THROWS_WITH(analyse_modes(mesh, options, {}), Contains(reason));
  };
  ModalOptions options = column_under(1);
  options.geometric_stiffness = true;
  refused(options, "prestress");
  options = column_under(1);
  options.fixed_directions.clear();
  refused(options, "nothing is fixed");
  AnalysisFields fields;
  CHECK_THROWS_WITH(analyse_modes(mesh, column_under(1), {}, nullptr, {}, &fields),
                    Contains("prestress"));
}

}  // namespace flexneck::fe_modal
