// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/modal_analysis.h"
#include "tests/support/beam_body.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kYoung = 7e10;
constexpr double kLength = 1.0;

/// A clamped beam along z without lateral contraction, so that the clamp adds nothing; residual
/// modes of the tip load.
ModalBody beam(const Eigen::Vector2d& section_m, std::array<int, 3> divisions, int count) {
  const mesher::Mesh mesh =
      testing::box(divisions, {section_m.x(), section_m.y(), kLength}, {"light", kYoung, 0, 2700})
          .make();
  ModalOptions options;
  options.mode_count = count;
  options.basis = BasisKind::residual;
  options.geometric_stiffness = true;
  options.held_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, kLength}}};
  options.sign_interface = "tip";
  options.length_m = kLength;
  options.rigid_parts = {"block"};
  return analyse_modes(mesh, options, {});
}

/// Smallest positive factor at which K + factor K_G is singular.
double buckling_load(const ModalBody& body, const Eigen::MatrixXd& geometric) {
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  const Eigen::MatrixXd scaled =
      omega.cwiseInverse().asDiagonal() * geometric * omega.cwiseInverse().asDiagonal();
  return -1 / testing::symmetric_eigenvalues(scaled)[0];
}

/// int (L^2 - z^2) / 2 phi'^2 dz over int phi^2 dz of a beam's n-th mode: how much the square of
/// its frequency rises with the square of the spin about an axis through the root.
double southwell(std::size_t n) {
  const auto [points, weights] = testing::gauss_rule(40);
  double sum = 0;
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const double slope = testing::clamped_free_shape(n, points[k]).second;
    sum += weights[k] * (1 - points[k] * points[k]) / 2 * slope * slope;
  }
  return sum;
}

/// int w_n'^2 from the root to z, of the mass-normalised n-th bending mode of an Euler beam.
double drawn(std::size_t n, double z, double mass) {
  const auto [points, weights] = testing::gauss_rule(40);
  double sum = 0;
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const double slope = testing::clamped_free_shape(n, points[k] * z / kLength).second;
    sum += weights[k] * z * slope * slope / (kLength * kLength * mass);
  }
  return sum;
}

/// int rho psi_k . chi, chi drawing all sections towards the root as the n-th bending mode does:
/// by the trapezoidal rule over the layers of nodes.
double work_on_drawing(const ModalBody& body, std::size_t k, std::size_t n, double mass) {
  std::map<double, std::pair<double, int>> layers;  // height: sum of psi_z, nodes
  for (Eigen::Index i = 0; i < body.nodes_m.cols(); ++i) {
    auto& [sum, count] = layers[std::round(1e6 * body.nodes_m(2, i)) / 1e6];
    sum += body.shapes[k](2, i);
    ++count;
  }
  double work = 0;
  double z_before = 0;
  double before = 0;
  for (const auto& [z, layer] : layers) {
    const double here = -layer.first / layer.second * drawn(n, z, mass);
    work += (z - z_before) * (before + here) / 2;
    z_before = z;
    before = here;
  }
  return mass / kLength * work;
}

}  // namespace

TEST_CASE(
    "a spun beam stiffens by Southwell's coefficients, a pushed column buckles at Euler's load") {
  // Thickness over length 1/50: shear and rotary inertia count for some (h/L)^2 b^2.
  constexpr double kShear = 3e-3;
  const ModalBody body = beam({0.02, 0.03}, {1, 1, 12}, 6);
  REQUIRE(body.geometric_stiffness);
  const GeometricStiffness& geometric = *body.geometric_stiffness;
  CHECK(southwell(0) == Approx(1.193).margin(0.001));  // the textbooks' coefficient
  // Spin about x: bending along x is the flapping of a blade, along y stays in the plane.
  for (const std::size_t n : {0U, 1U}) {
    for (const std::string kind : {"fore-aft", "lateral"}) {
      const Eigen::Index k = body.mode_index(kind + " bending " + std::to_string(n + 1));
      CAPTURE(kind, n);
      CHECK(geometric.velocity_products[0](k, k) ==
            Approx(southwell(n)).epsilon(kShear * (n == 0 ? 1 : 4)));
    }
  }
  const double EI = kYoung * 0.03 * std::pow(0.02, 3) / 12;
  const double euler = std::pow(std::numbers::pi / (2 * kLength), 2) * EI;
  const GeometricStiffness::OfInterface& tip = geometric.interfaces.at(0);
  CHECK(tip.name == "tip");
  CHECK(buckling_load(body, -tip.force[2]) == Approx(euler).epsilon(1e-3));
  // Own weight: 7.837 EI / L^2 (Greenhill) is the critical weight.
  const double weight = 7.837 * EI / (kLength * kLength);
  const double mass = 2700 * 0.02 * 0.03 * kLength;
  CHECK(buckling_load(body, geometric.acceleration[2]) == Approx(weight / mass).epsilon(2e-3));
  // The inertia of the vector that moves the tip most along the axis is that of a stretched bar.
  Eigen::Index axial = 0;
  body.interface("tip").translation.row(2).cwiseAbs().maxCoeff(&axial);
  const Eigen::Index flap = body.mode_index("fore-aft bending 1");
  REQUIRE(geometric.modal_acceleration.size() == static_cast<std::size_t>(body.mode_count()));
  const auto k = static_cast<std::size_t>(axial);
  CHECK(geometric.modal_acceleration[k](flap, flap) ==
        Approx(work_on_drawing(body, k, 0, mass)).epsilon(1e-2));
}

TEST_CASE("a deep cantilever under a tip load topples sideways at Prandtl's load") {
  // Bent in its plane it is stressed by bending and shear, and by nothing else.
  constexpr double kThickness = 0.01;
  constexpr double kDepth = 0.05;
  // Twist wants a fine mesh: of 4 x 24 elements in the plane, one through the thickness, it is
  // still 1.4 % high, of 2 x 6 x 40 0.12 %, of 2 x 8 x 48 -0.03 %.
  constexpr double kMesh = 2e-3;
  const ModalBody body = beam({kThickness, kDepth}, {2, 6, 40}, 12);
  const double EI = kYoung * kDepth * std::pow(kThickness, 3) / 12;
  const double torsion_constant =
      kDepth * std::pow(kThickness, 3) / 3 * (1 - 0.630 * kThickness / kDepth);
  const double GJ = kYoung / 2 * torsion_constant;
  // The clamp keeps the root from warping: Timoshenko and Gere, Theory of Elastic Stability, 6.5.
  const double warping = kYoung * std::pow(kThickness * kDepth, 3) / 144;
  const double held = 1 - std::sqrt(warping / GJ) / kLength;
  const double expected = 4.013 / (held * held) * std::sqrt(EI * GJ) / (kLength * kLength);
  const GeometricStiffness::OfInterface& tip = body.geometric_stiffness->interfaces.at(0);
  CHECK(buckling_load(body, tip.force[1]) == Approx(expected).epsilon(kMesh));
}

}  // namespace flexneck::fe_modal
