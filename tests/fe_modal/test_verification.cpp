// SPDX-License-Identifier: GPL-3.0-or-later
// Published cases and closed forms in addition to those of test_modal_analysis.cpp (cantilever,
// torsion and stretch of a tube).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

/// A cylinder about the z axis, meshed as a square that is pushed outwards.
testing::BlockMesh cylinder(int divisions, double radius_m, double height_m) {
  testing::BlockMesh block = testing::box({divisions, divisions, 1}, {1, 1, 1}, {});
  block.position = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double u = 2 * p[0] - 1;
    const double v = 2 * p[1] - 1;
    return {radius_m * u * std::sqrt(1 - v * v / 2), radius_m * v * std::sqrt(1 - u * u / 2),
            height_m * p[2]};
  };
  return block;
}

ModalOptions fixed_at_bottom(int mode_count) {
  ModalOptions options;
  options.fixed_set = "bottom";
  options.mode_count = mode_count;
  return options;
}

/// Relative error of the nearest of a body's frequencies to the expected one.
double nearest_error(const ModalBody& body, double expected_Hz) {
  return (body.frequencies_Hz.array() / expected_Hz - 1).abs().minCoeff();
}

/// Basis, in columns, of the motions of a plate's free nodes, one element thick, that are symmetric
/// about its middle plane: equal above and below in the plane, opposite across it, and zero across
/// it in the middle.
Eigen::MatrixXd membrane_motions(const mesher::Mesh& plate, const DofMap& dof_map) {
  const auto layer = plate.nodes.size() / 3;
  std::vector<Eigen::VectorXd> columns;
  const auto add = [&](std::vector<std::pair<std::size_t, double>> entries, int direction) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(dof_map.dof_count());
    for (const auto& [node, value] : entries) {
      const std::int32_t index = dof_map.index(static_cast<std::int32_t>(node));
      if (index >= 0) column[3 * index + direction] = value;
    }
    if (column.any()) columns.push_back(column);
  };
  for (std::size_t k = 0; k < layer; ++k) {
    for (const int direction : {0, 1}) {
      add({{k, 1}, {k + 2 * layer, 1}}, direction);
      add({{k + layer, 1}}, direction);
    }
    add({{k, -1}, {k + 2 * layer, 1}}, 2);
  }
  Eigen::MatrixXd result(dof_map.dof_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    result.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return result;
}

}  // namespace

TEST_CASE("NAFEMS FV32: membrane frequencies of a tapered cantilever") {
  // The plate is 10 m long, 5 m wide at the clamp, 1 m at the tip, 0.05 m thick; plane stress, so
  // that the solid plate may change its thickness but not bend. Targets: NAFEMS, Free Vibration
  // Benchmarks, 1987, test 32. The solid has the clamped edge fixed across the plate too. The
  // remaining error is that of the mesh: 8 x 4 elements are 0.3 % high in the fifth, the others
  // below 0.1 %.
  constexpr double kTolerance = 4e-3;
  constexpr std::array kTargets_Hz = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
  testing::BlockMesh block = testing::box({8, 4, 1}, {1, 1, 1}, {"steel", 2e11, 0.3, 8000});
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return {10 * p[0], (p[1] - 0.5) * (5 - 4 * p[0]), 0.05 * (p[2] - 0.5)};
  };
  const mesher::Mesh plate = block.make();
  std::vector<std::int32_t> clamped;
  for (std::size_t k = 0; k < plate.nodes.size(); ++k) {
    if (plate.nodes[k][0] == 0) clamped.push_back(static_cast<std::int32_t>(k));
  }
  const DofMap dof_map(plate, clamped);
  const SystemMatrices system = assemble(plate, dof_map);
  const Eigen::MatrixXd motions = membrane_motions(plate, dof_map);
  const Eigen::MatrixXd stiffness = motions.transpose() * (dense(system.stiffness.get()) * motions);
  const Eigen::MatrixXd mass = motions.transpose() * (dense(system.mass.get()) * motions);
  const Eigen::VectorXd values = testing::dense_pairs(stiffness, mass).values;
  for (std::size_t k = 0; k < kTargets_Hz.size(); ++k) {
    const double found = std::sqrt(values[static_cast<Eigen::Index>(k)]) / (2 * std::numbers::pi);
    CAPTURE(k, found);
    CHECK(std::abs(found / kTargets_Hz[k] - 1) < kTolerance);
  }
}

TEST_CASE("a solid round bar twists at the frequencies of waves, n odd quarters") {
  // The frequencies are (2n - 1) sqrt(G / rho) / 4L. The remaining error is that of the mesh: three
  // elements to a quarter wave of n = 2.
  constexpr double kTolerance = 2e-4;
  constexpr double kLength = 0.2;
  testing::BlockMesh bar = cylinder(2, 0.05, kLength);
  bar.slices = {{"bar", 9, {"steel", 2.1e11, 0.3, 7850}}};
  const ModalBody body = analyse_modes(bar.make(), fixed_at_bottom(12), {});
  const double first = std::sqrt(2.1e11 / 2.6 / 7850) / (4 * kLength);
  CHECK(nearest_error(body, first) < kTolerance);
  CHECK(nearest_error(body, 3 * first) < kTolerance);
}

TEST_CASE("a free block has the Lamé mode of its square section") {
  // The mode u = (cos kx sin ky, -sin kx cos ky, 0) with k = pi / a and faces at x, y = 0, a has
  // pure shear but no traction on every face, so it is exact for any height and any nu: f = sqrt(G
  // / rho) / (a sqrt 2). Six rigid motions come first.
  constexpr double kTolerance = 5e-4;  // error of four elements to a half wave
  constexpr double kSide = 0.1;
  const mesher::Material material{"steel", 2.1e11, 0.3, 7850};
  const mesher::Mesh mesh = testing::box({4, 4, 2}, {kSide, kSide, 0.06}, material).make();
  ModalOptions options;
  options.mode_count = 20;
  const ModalBody body = analyse_modes(mesh, options, {});
  CHECK(body.frequencies_Hz[5] == 0);
  CHECK(body.frequencies_Hz[6] > 0);
  const double expected = std::sqrt(2.1e11 / 2.6 / 7850 / 2) / kSide;
  Eigen::Index nearest = 0;
  (body.frequencies_Hz.array() - expected).abs().minCoeff(&nearest);
  CHECK(std::abs(body.frequencies_Hz[nearest] / expected - 1) < kTolerance);
  // The closed form is the mode's shape, with the box centred on the axis.
  Eigen::Matrix3Xd closed_form(3, body.nodes_m.cols());
  constexpr double k = std::numbers::pi / kSide;
  for (Eigen::Index n = 0; n < closed_form.cols(); ++n) {
    const double x = k * (body.nodes_m(0, n) + kSide / 2);
    const double y = k * (body.nodes_m(1, n) + kSide / 2);
    closed_form.col(n) << std::cos(x) * std::sin(y), -std::sin(x) * std::cos(y), 0;
  }
  const Eigen::Matrix3Xd& shape = body.shapes[static_cast<std::size_t>(nearest)];
  const double product = closed_form.cwiseProduct(shape).sum();
  CHECK(product * product / (closed_form.squaredNorm() * shape.squaredNorm()) > 0.999);
}

TEST_CASE("a mass on a bonded rubber disc moves at the frequency of Gent's modulus") {
  // The apparent modulus is Ea = E (1 + 2 S^2) and 1/Ea' = 1/Ea + 1/B, S = D / 4t, B the bulk
  // modulus: a heavy plate on the disc moves with (2 pi f)^2 = Ea' A / (t m). The formula neglects
  // the effect of the bulge on the pressure in a compressible disc: against the solution of
  // Chalhoub and Kelly (Int. J. Solids Struct. 26 (1990) 743) it is up to a few per cent off, hence
  // the tolerance. For such a flat disc displacement elements alone are far too stiff.
  constexpr double kTolerance = 0.03;
  constexpr double kRadius = 0.04, kThickness = 0.005, kPlate = 0.02;
  constexpr double kYoung = 4e6, kPoisson = 0.499;
  testing::BlockMesh disc = cylinder(6, kRadius, kThickness + kPlate);
  disc.slices = {{"rubber", 1, {"rubber", kYoung, kPoisson, 1}},
                 {"plate", 4, {"steel", 2.1e11, 0.3, 7850}}};
  const auto frequency = [&](Formulation formulation) {
    ModalOptions options = fixed_at_bottom(8);
    options.formulation.of_others = formulation;
    options.rigid_parts = {"plate"};
    const ModalBody body = analyse_modes(disc.make(), options, {});
    return body.frequencies_Hz[body.mode_index("axial 1")];
  };
  const double shape_factor = 2 * kRadius / (4 * kThickness);
  const double bulk = kYoung / (3 * (1 - 2 * kPoisson));
  const double apparent = 1 / (1 / (kYoung * (1 + 2 * shape_factor * shape_factor)) + 1 / bulk);
  const double expected =
      std::sqrt(apparent / (kThickness * 7850 * kPlate)) / (2 * std::numbers::pi);
  const double found = frequency(Formulation::mixed_pressure);
  CAPTURE(found, expected);
  CHECK(std::abs(found / expected - 1) < kTolerance);
  CHECK(frequency(Formulation::displacement) / expected > 1.05);
}

}  // namespace flexneck::fe_modal
