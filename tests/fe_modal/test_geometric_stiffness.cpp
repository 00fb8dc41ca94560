// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "tests/support/beam_body.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kYoung = 7e10;
constexpr double kLength = 1.0;

/// A clamped beam along z without lateral contraction, so that the clamp adds no stiffness, with
/// residual modes of the tip load.
ModalBody beam(const Eigen::Vector2d& section_m, std::array<int, 3> divisions, int count) {
  const mesher::Mesh mesh =
      testing::box(divisions, {section_m.x(), section_m.y(), kLength}, {"light", kYoung, 0, 2700})
          .make();
  ModalOptions options;
  options.mode_count = count;
  options.basis = BasisKind::residual;
  options.geometric_stiffness = true;
  options.fixed_set = "bottom";
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

/// Southwell's coefficient int (L^2 - z^2) / 2 phi'^2 dz over int phi^2 dz of a beam's n-th mode:
/// ratio of the rise of its squared frequency to the squared rate of spin about an axis through the
/// root.
double southwell(std::size_t n) {
  const auto [points, weights] = testing::gauss_rule(40);
  double sum = 0;
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const double slope = testing::clamped_free_shape(n, points[k]).second;
    sum += weights[k] * (1 - points[k] * points[k]) / 2 * slope * slope;
  }
  return sum;
}

/// Shortening int w_n'^2 from the root to z, of the mass-normalised n-th bending mode of an Euler
/// beam.
double drawn(std::size_t n, double z, double mass) {
  const auto [points, weights] = testing::gauss_rule(40);
  double sum = 0;
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const double slope = testing::clamped_free_shape(n, points[k] * z / kLength).second;
    sum += weights[k] * z * slope * slope / (kLength * kLength * mass);
  }
  return sum;
}

/// Work int rho psi_k . chi, where chi moves all sections towards the root as the n-th bending mode
/// does: by the trapezoidal rule over the layers of nodes.
double work_on_drawing(const ModalBody& body, std::size_t k, std::size_t n, double mass) {
  std::map<double, std::pair<double, int>> layers;  // by height: sum of psi_z, number of nodes
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

/// A clamped stub without any symmetry, rotated relative to its axes.
ModalBody stub(mesher::ElementKind kind, Formulation formulation, const Eigen::Matrix3d& turn) {
  testing::BlockMesh block = testing::box({1, 1, 2}, {1, 1, 1}, {"plastic", 3e9, 0.4, 1200});
  block.position = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double taper = 1 - 0.3 * p.z();
    return turn * Eigen::Vector3d(0.05 * taper * (p.x() - 0.3) + 0.02 * p.z() * p.z(),
                                  0.08 * taper * (p.y() - 0.4) + 0.01 * p.x() * p.z(),
                                  0.2 * p.z() * (1 + 0.1 * p.x()));
  };
  ModalOptions options;
  options.mode_count = 4;
  options.formulation.of_others = formulation;
  options.basis = BasisKind::residual;
  options.geometric_stiffness = true;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", turn * Eigen::Vector3d(0.02, 0, 0.2)}};
  options.sign_interface = "tip";
  options.length_m = 0.2;
  options.rigid_parts = {"block"};
  return analyse_modes(testing::with_kind(block.make(), kind), options, {});
}

/// Signs of the modes of a body relative to those of the rotated body: a diagonal of +1 and -1.
Eigen::VectorXd signs_of(const ModalBody& turned, const ModalBody& body,
                         const Eigen::Matrix3d& turn) {
  Eigen::VectorXd signs(body.mode_count());
  for (Eigen::Index k = 0; k < signs.size(); ++k) {
    const auto l = static_cast<std::size_t>(k);
    signs[k] = turned.shapes[l].cwiseProduct(turn * body.shapes[l]).sum() < 0 ? -1 : 1;
  }
  return signs;
}

/// Component along an axis of matrices for x, y, z.
Eigen::MatrixXd along(const Eigen::Vector3d& axis, const std::vector<Eigen::MatrixXd>& matrices) {
  return axis.x() * matrices.at(0) + axis.y() * matrices.at(1) + axis.z() * matrices.at(2);
}

/// Geometric stiffness under a spin, from the matrices for its products xx, yy, zz, xy, xz, yz.
Eigen::MatrixXd spun(const Eigen::Vector3d& w, const std::vector<Eigen::MatrixXd>& products) {
  return w.x() * w.x() * products.at(0) + w.y() * w.y() * products.at(1) +
         w.z() * w.z() * products.at(2) + w.x() * w.y() * products.at(3) +
         w.x() * w.z() * products.at(4) + w.y() * w.z() * products.at(5);
}

/// Relative error of the modes, from the eigensolver's tolerance.
constexpr double kExact = 1e-7;

double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).norm() / expected.norm();
}

/// Difference of matrices over the modes, some of which have the opposite sign.
double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected,
                  const Eigen::VectorXd& signs) {
  return difference(found, signs.asDiagonal() * expected * signs.asDiagonal());
}

void check_inertia(const ModalBody& turned, const ModalBody& body, const Eigen::Matrix3d& turn,
                   const Eigen::VectorXd& signs) {
  const InertiaInvariants& found = turned.invariants;
  const InertiaInvariants& inertia = body.invariants;
  CHECK(difference(found.S1, turn * inertia.S1) < kExact);
  CHECK(difference(found.J0, turn * inertia.J0 * turn.transpose()) < kExact);
  CHECK(difference(found.S2, turn * inertia.S2 * signs.asDiagonal()) < kExact);
  CHECK(difference(found.N0, turn * inertia.N0 * signs.asDiagonal()) < kExact);
  for (Eigen::Index k = 0; k < signs.size(); ++k) {
    const auto l = static_cast<std::size_t>(k);
    CHECK(difference(signs[k] * found.G0[l], turn * inertia.G0[l] * turn.transpose()) < kExact);
  }
  const Interface& tip = body.interface("tip");
  const Interface& there = turned.interface("tip");
  CHECK(difference(there.translation, turn * tip.translation * signs.asDiagonal()) < kExact);
  CHECK(difference(there.rotation, turn * tip.rotation * signs.asDiagonal()) < kExact);
}

/// @param there  the axis in the rotated body
void check_stiffness(const GeometricStiffness& turned, const Eigen::Vector3d& there,
                     const GeometricStiffness& body, const Eigen::Vector3d& axis,
                     const Eigen::VectorXd& signs) {
  CHECK(difference(spun(there, turned.velocity_products), spun(axis, body.velocity_products),
                   signs) < kExact);
  CHECK(difference(along(there, turned.acceleration), along(axis, body.acceleration), signs) <
        kExact);
  CHECK(difference(along(there, turned.angular_acceleration),
                   along(axis, body.angular_acceleration), signs) < kExact);
  const GeometricStiffness::OfInterface& tip = body.interfaces.at(0);
  const GeometricStiffness::OfInterface& turned_tip = turned.interfaces.at(0);
  CHECK(difference(along(there, turned_tip.force), along(axis, tip.force), signs) < kExact);
  CHECK(difference(along(there, turned_tip.moment), along(axis, tip.moment), signs) < kExact);
}

}  // namespace

TEST_CASE(
    "a spun beam stiffens by Southwell's coefficients, a pushed column buckles at Euler's load") {
  // Thickness over length is 1/50: shear and rotary inertia contribute some (h/L)^2 b^2.
  constexpr double kShear = 3e-3;
  const ModalBody body = beam({0.02, 0.03}, {1, 1, 12}, 6);
  REQUIRE(body.geometric_stiffness);
  const GeometricStiffness& geometric = *body.geometric_stiffness;
  CHECK(southwell(0) == Approx(1.193).margin(0.001));  // the textbooks' coefficient
  // For spin about x, bending along x is the flapping of a blade, bending along y is in the plane
  // of rotation.
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
  // The critical weight is 7.837 EI / L^2 (Greenhill).
  const double weight = 7.837 * EI / (kLength * kLength);
  const double mass = 2700 * 0.02 * 0.03 * kLength;
  CHECK(buckling_load(body, geometric.acceleration[2]) == Approx(weight / mass).epsilon(2e-3));
  // The inertia of the vector with the largest axial motion of the tip is that of a stretched bar.
  Eigen::Index axial = 0;
  body.interface("tip").translation.row(2).cwiseAbs().maxCoeff(&axial);
  const Eigen::Index flap = body.mode_index("fore-aft bending 1");
  REQUIRE(geometric.modal_acceleration.size() == static_cast<std::size_t>(body.mode_count()));
  const auto k = static_cast<std::size_t>(axial);
  CHECK(geometric.modal_acceleration[k](flap, flap) ==
        Approx(work_on_drawing(body, k, 0, mass)).epsilon(1e-2));
}

TEST_CASE("a deep cantilever under a tip load topples sideways at Prandtl's load") {
  // Bending in its plane stresses the beam by bending and shear only.
  constexpr double kThickness = 0.01;
  constexpr double kDepth = 0.05;
  // Torsion requires a fine mesh: with 4 x 24 elements in the plane, one through the thickness, the
  // load is still 1.4 % high, with 2 x 6 x 40 0.12 %, with 2 x 8 x 48 -0.03 %.
  constexpr double kMesh = 2e-3;
  const ModalBody body = beam({kThickness, kDepth}, {2, 6, 40}, 12);
  const double EI = kYoung * kDepth * std::pow(kThickness, 3) / 12;
  const double torsion_constant =
      kDepth * std::pow(kThickness, 3) / 3 * (1 - 0.630 * kThickness / kDepth);
  const double GJ = kYoung / 2 * torsion_constant;
  // The clamp prevents warping of the root: Timoshenko and Gere, Theory of Elastic Stability, 6.5.
  const double warping = kYoung * std::pow(kThickness * kDepth, 3) / 144;
  const double held = 1 - std::sqrt(warping / GJ) / kLength;
  const double expected = 4.013 / (held * held) * std::sqrt(EI * GJ) / (kLength * kLength);
  const GeometricStiffness::OfInterface& tip = body.geometric_stiffness->interfaces.at(0);
  CHECK(buckling_load(body, tip.force[1]) == Approx(expected).epsilon(kMesh));
}

TEST_CASE("a body of any elements that is turned about in its axes is the same body") {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(0.3, -0.8, 0.41, 0.77).normalized().toRotationMatrix();
  const mesher::ElementKind kind = GENERATE(from_range(kVolumes));
  const Formulation formulation = GENERATE(from_range(kFormulations));
  if (!offered(kind, formulation)) return;
  CAPTURE(mesher::name_of(kind), name_of(formulation));
  const ModalBody body = stub(kind, formulation, Eigen::Matrix3d::Identity());
  const ModalBody turned = stub(kind, formulation, turn);
  REQUIRE(turned.mode_count() == body.mode_count());
  CHECK(difference(turned.frequencies_Hz, body.frequencies_Hz) < kExact);
  const Eigen::VectorXd signs = signs_of(turned, body, turn);
  check_inertia(turned, body, turn, signs);
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(1, 2, -3), Eigen::Vector3d(-2, 1, 1), Eigen::Vector3d(1, -1, 2)})
    check_stiffness(*turned.geometric_stiffness, turn * axis, *body.geometric_stiffness, axis,
                    signs);
  for (Eigen::Index k = 0; k < signs.size(); ++k) {
    const auto of_mode = [k](const ModalBody& of) {
      return of.geometric_stiffness->modal_acceleration[static_cast<std::size_t>(k)];
    };
    CHECK(difference(signs[k] * of_mode(turned), of_mode(body), signs) < kExact);
  }
}

}  // namespace flexneck::fe_modal
