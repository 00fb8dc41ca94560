// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "mesher/slits/slits.h"
#include "tests/support/block_mesh.h"
#include "tests/support/crack_faces.h"

namespace flexneck::fe_modal {
namespace {

// A cantilever along z, clamped at z = 0, with a crack across its front, x > 0.
constexpr double kLength = 0.4;
constexpr double kBeamDepth = 0.02;
constexpr double kWidth = 0.01;
constexpr double kCrackAt = 0.08;
// With a Poisson's ratio of zero plane stress and plane strain are the same.
const mesher::Material kMaterial{
    .name = "steel", .youngs_modulus_Pa = 2e11, .poissons_ratio = 0, .density_kg_m3 = 7800};

/// Positions of thin layers at the crack that grow away from it; the crack lies at w = 1/2.
Eigen::Vector3d place(const Eigen::Vector3d& p) {
  constexpr double kGrowth = 4;
  const auto graded = [](double t) { return std::expm1(kGrowth * t) / std::expm1(kGrowth); };
  const double z = p[2] < 0.5 ? kCrackAt * (1 - graded(1 - 2 * p[2]))
                              : kCrackAt + (kLength - kCrackAt) * graded(2 * p[2] - 1);
  return {(p[0] - 0.5) * kBeamDepth, p[1] * kWidth, z};
}

/// Faces of the crack from the front to `depth`.
mesher::FaceSet crack(const mesher::Mesh& mesh, double depth) {
  constexpr double kNear = 1e-9;
  return testing::crack_faces(mesh, "crack", [&](const Eigen::Vector3d& x) {
    return std::abs(x.z() - kCrackAt) < kNear && x.x() > kBeamDepth / 2 - depth - kNear;
  });
}

double first_frequency(const mesher::Mesh& mesh) {
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const LinearSolver factor(system.stiffness.get(), 0);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 2);
  // Bending across the depth opens the crack. The other mode bends across the width.
  const Eigen::Index mode = std::abs(dof_map.expand(pairs.vectors.col(0)).row(0).sum()) >
                                    std::abs(dof_map.expand(pairs.vectors.col(0)).row(1).sum())
                                ? 0
                                : 1;
  return std::sqrt(pairs.values[mode]) / (2 * std::numbers::pi);
}

/// Rotation per bending moment that an edge crack adds, from the energy released by its growth in
/// plane stress, with K_I = 6 M / (b h^2) sqrt(pi a) F(a / h) (Tada, Paris and Irwin, The Stress
/// Analysis of Cracks Handbook, 2.14; within 0.2 % up to a / h = 0.6).
double crack_compliance(double depth) {
  const auto F = [](double s) {
    return 1.122 + s * (-1.40 + s * (7.33 + s * (-13.08 + s * 14.0)));
  };
  constexpr int kPoints = 1000;
  const double ratio = depth / kBeamDepth;
  double integral = 0;
  for (int k = 0; k < kPoints; ++k) {
    const double s = ratio * (k + 0.5) / kPoints;
    integral += s * F(s) * F(s) * ratio / kPoints;
  }
  return 72 * std::numbers::pi * integral /
         (kMaterial.youngs_modulus_Pa * kWidth * kBeamDepth * kBeamDepth);
}

/// Transfer matrix of a length of Euler's beam for deflection, slope, moment and shear.
Eigen::Matrix4d transfer(double length, double omega, double stiffness, double mass_per_length) {
  const double k = std::sqrt(omega) * std::pow(mass_per_length / stiffness, 0.25);
  const double x = k * length;
  const double s = (std::cosh(x) + std::cos(x)) / 2;
  const double t = (std::sinh(x) + std::sin(x)) / 2;
  const double u = (std::cosh(x) - std::cos(x)) / 2;
  const double v = (std::sinh(x) - std::sin(x)) / 2;
  const double e = stiffness;
  Eigen::Matrix4d matrix;
  matrix << s, t / k, u / (e * k * k), v / (e * k * k * k),  //
      k * v, s, t / (e * k), u / (e * k * k),                //
      e * k * k * u, e * k * v, s, t / k,                    //
      e * k * k * k * t, e * k * k * u, k * v, s;
  return matrix;
}

/// First frequency of the clamped beam with a hinge spring in place of the crack.
double beam_frequency(double compliance) {
  const double stiffness = kMaterial.youngs_modulus_Pa * kWidth * std::pow(kBeamDepth, 3) / 12;
  const double mass_per_length = kMaterial.density_kg_m3 * kWidth * kBeamDepth;
  const auto at_free_end = [&](double hertz) {
    const double omega = 2 * std::numbers::pi * hertz;
    Eigen::Matrix4d hinge = Eigen::Matrix4d::Identity();
    hinge(1, 2) = compliance;
    const Eigen::Matrix4d whole = transfer(kLength - kCrackAt, omega, stiffness, mass_per_length) *
                                  hinge * transfer(kCrackAt, omega, stiffness, mass_per_length);
    return whole.bottomRightCorner<2, 2>().determinant();
  };
  double low = 1;
  double high = 0.5615 / (kLength * kLength) * std::sqrt(stiffness / mass_per_length);
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (at_free_end(middle) > 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

TEST_CASE(
    "an open crack lowers a beam's frequency as fracture mechanics has it, a closed one not") {
  testing::BlockMesh beam;
  beam.x_divisions = 20;
  beam.y_divisions = 1;
  beam.slices = {{"beam", 40, kMaterial}};
  beam.position = place;
  const mesher::Mesh whole = beam.make();
  const double uncracked = first_frequency(whole);
  for (const double share : {0.2, 0.5}) {
    mesher::Mesh open = whole;
    open.face_sets.push_back(crack(whole, share * kBeamDepth));
    mesher::Mesh closed = open;
    mesher::open_slits(open, {"crack"}, false);
    mesher::open_slits(closed, {"crack"}, true);
    const double expected =
        beam_frequency(crack_compliance(share * kBeamDepth)) / beam_frequency(0);
    const double found = first_frequency(open) / uncracked;
    INFO(share << ": " << found << " of the uncracked beam's frequency, expected " << expected);
    // Elements without a singular tip release 2 % less energy; a beam's own error is of its
    // depth over its length, squared.
    CHECK(1 - found == Approx(1 - expected).epsilon(0.03));
    CHECK(first_frequency(closed) == Approx(uncracked).epsilon(1e-9));
  }
}

}  // namespace flexneck::fe_modal
