// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::fe_modal {
namespace {

/// Displacements under forces and rotations under moments are of different sizes.
void check_same_compliance(const Eigen::Matrix<double, 6, 6>& one,
                           const Eigen::Matrix<double, 6, 6>& other) {
  const Eigen::Matrix<double, 6, 1> scale = other.diagonal().cwiseSqrt().cwiseInverse();
  CHECK((scale.asDiagonal() * (one - other) * scale.asDiagonal()).cwiseAbs().maxCoeff() < 1e-8);
}

void check_same_modes(const mesher::Mesh& mesh, ModalOptions options) {
  const ModalBody direct = analyse_modes(mesh, options, {});
  options.solver = Solver::iterative;
  const ModalBody iterative = analyse_modes(mesh, options, {});
  // What it took stands there, and it is no factor of the whole.
  CHECK_THAT(iterative.solver, Catch::Matchers::Matches("iterative: [0-9]+ subdomains, .* "
                                                        "[1-9][0-9]* Davidson, .*"));
  REQUIRE(iterative.mode_count() == direct.mode_count());
  for (Eigen::Index k = 0; k < direct.mode_count(); ++k) {
    INFO("mode " << k);
    // Of a rigid-body motion, zero, the iteration leaves some ten-thousandths of a hertz.
    CHECK(iterative.frequencies_Hz[k] == Approx(direct.frequencies_Hz[k])
                                             .epsilon(1e-9)
                                             .margin(1e-6 * direct.frequencies_Hz.maxCoeff()));
  }
  CHECK(iterative.orthogonality < 1e-9);
  REQUIRE(iterative.interfaces.size() == direct.interfaces.size());
  for (std::size_t k = 0; k < direct.interfaces.size(); ++k) {
    check_same_compliance(iterative.interfaces[k].response.value().compliance,
                          direct.interfaces[k].response.value().compliance);
  }
  REQUIRE(iterative.attached.size() == direct.attached.size());
  for (std::size_t k = 0; k < direct.attached.size(); ++k) {
    CHECK(iterative.attached[k].frequencies_Hz.isApprox(direct.attached[k].frequencies_Hz, 1e-8));
  }
}

}  // namespace

TEST_CASE(
    "by iteration the neck, of metal and nearly incompressible rubber, has its modes and "
    "compliance") {
  geometry::NeckDivisions divisions;
  divisions.quadrant = 2;
  divisions.inner_ring = 2;
  divisions.outer_ring = 1;
  divisions.rubber_layers = 1;
  geometry::NeckParameters neck = testing::neck_parameters("C");
  neck.bolt_patch_radius = parse_quantity("0.4 in", "m");
  const mesher::Mesh mesh = mesher::mesh_script(testing::neck_mesh_options(neck, divisions), {});
  ModalOptions options;
  options.mode_count = 6;
  options.fixed_set = "bolts";
  options.interfaces = {{"top", "top", {0, 0, neck.length}}};
  options.attachments = {
      {"head", "top", 4.5, {0, 0, neck.length + 0.05}, 0.02 * Eigen::Matrix3d::Identity()}};
  check_same_modes(mesh, options);
}

TEST_CASE("by iteration double frequencies, rigid-body motions and inertia relief are found") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 4}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.mode_count = 5;
  options.fixed_set = "bottom";
  options.interfaces = {{"top", "top", {0, 0, 0.3}}};
  check_same_modes(mesh, options);
  options.mode_count = 9;
  options.fixed_set = "";
  check_same_modes(mesh, options);
}

TEST_CASE("modes by iteration are counted by inertia where memory holds the factor") {
  const mesher::Mesh mesh =
      testing::box({1, 1, 2}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.mode_count = 2;
  options.fixed_set = "bottom";
  options.certify = true;
  const ModalBody direct = analyse_modes(mesh, options, {});
  options.solver = Solver::iterative;
  const ModalBody iterative = analyse_modes(mesh, options, {});
  CHECK_THAT(iterative.certificate, Catch::Contains("certified: no mode is missing below"));
  CHECK(iterative.certificate == direct.certificate);
  // Both are the finer mesh's to a quarter of the change from mesh to mesh.
  const double refined_Hz = direct.modes[0].mesh_error->refined_Hz;
  CHECK(iterative.modes[0].mesh_error->refined_Hz ==
        Approx(refined_Hz).margin(0.25 * std::abs(direct.frequencies_Hz[0] - refined_Hz)));
}

}  // namespace flexneck::fe_modal
