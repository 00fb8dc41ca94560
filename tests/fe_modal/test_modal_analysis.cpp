// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/element/rounding.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

ModalOptions fixed_at_bottom(int mode_count, double height_m) {
  ModalOptions options;
  options.mode_count = mode_count;
  options.fixed_set = "bottom";
  options.fixed_interface = "root";
  options.fixed_position_m = {0.01, 0.02, 0};
  options.interfaces = {{"tip", "top", {0, 0, height_m}}};
  options.rigid_parts = {"block"};
  options.sign_interface = "tip";
  options.length_m = height_m;
  return options;
}

double frequency(const ModalBody& body, const std::string& name) {
  return body.frequencies_Hz[body.mode_index(name)];
}

/// Euler's first cantilever frequency in Hz.
double euler_cantilever(double young, double density, double side, double length) {
  constexpr double kRoot = 1.8751040687119611;  // root of cos cosh = -1
  return kRoot * kRoot / (2 * std::numbers::pi) *
         std::sqrt(young * side * side / 12 / (density * std::pow(length, 4)));
}

/// Lowest frequency of a bar fixed at the bottom, in either formulation.
double lowest_frequency(const mesher::Mesh& mesh, Formulation formulation) {
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map, {formulation});
  const LinearSolver factor(system.stiffness.get(), 0);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 1);
  return std::sqrt(pairs.values[0]) / (2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a slender cantilever bends at Euler's frequency less shear and rotary inertia") {
  // Rayleigh's correction of the first mode, with int phi'^2 / int phi^2 = 4.648 / L^2 (by symmetry
  // the same for the shear force over the moment), is -4.648/2 (r/L)^2 (1 + E/kG), r^2 = h^2/12.
  // With nu = 0, k = 5/6, L/h = 20 it is -0.165 %. The remaining error is its own second order and
  // the mesh.
  constexpr double kTolerance = 5e-5;
  constexpr double kSide = 0.02, kLength = 0.4;
  const mesher::Material material{"steel", 2.1e11, 0, 7850};
  const mesher::Mesh mesh = testing::box({2, 2, 20}, {kSide, kSide, kLength}, material).make();
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(2, kLength), {});
  const double ratio = kSide * kSide / 12 / (kLength * kLength);
  const double expected =
      euler_cantilever(2.1e11, 7850, kSide, kLength) * (1 - 4.648 / 2 * ratio * (1 + 2 * 6.0 / 5));
  CHECK(std::abs(frequency(body, "fore-aft bending 1") / expected - 1) < kTolerance);
  CHECK(std::abs(frequency(body, "lateral bending 1") / expected - 1) < kTolerance);
}

TEST_CASE("a round tube twists and stretches at the frequencies of waves in a rod") {
  // The tube is fixed at one end: sqrt(G / rho) / 4 L for torsion, without warping in a round
  // section; sqrt(E / rho) / 4 L for stretch with nu = 0. The only expected deviation is that of
  // the mesh. The wall is thick and the tube short, so that no bending modes come between.
  constexpr double kTolerance = 1e-5;
  constexpr double kLength = 0.3;
  const mesher::Material material{"steel", 2.1e11, 0, 7850};
  const mesher::Mesh mesh = testing::tube({1, 8, 6}, 0.04, 0.06, kLength, material).make();
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(6, kLength), {});
  const double stretch = std::sqrt(2.1e11 / 7850) / (4 * kLength);
  CHECK(std::abs(frequency(body, "axial 1") / stretch - 1) < kTolerance);
  CHECK(std::abs(frequency(body, "torsion 1") / (stretch * std::sqrt(0.5)) - 1) < kTolerance);
}

TEST_CASE("a free block has six zero frequencies and the inertia of a block") {
  const Eigen::Vector3d size(0.2, 0.1, 0.3);
  const mesher::Mesh mesh = testing::box({2, 2, 2}, size, kSteel).make();
  ModalOptions options;
  options.mode_count = 8;
  const ModalBody body = analyse_modes(mesh, options, {});
  CHECK(body.boundary == "free");
  CHECK(body.frequencies_Hz.head(6).maxCoeff() < 1e-4 * body.frequencies_Hz[6]);
  CHECK(body.frequencies_Hz[6] > 1000);
  // Each of the six modes is rigid: its strain energy is zero, and together they carry all of the
  // block's linear momentum: sum of S2 S2^T = mass I.
  const Eigen::Matrix3d momentum =
      body.invariants.S2.leftCols<6>() * body.invariants.S2.leftCols<6>().transpose();
  const double mass = 7850 * size.prod();
  CHECK(body.invariants.mass == Approx(mass).epsilon(1e-12));
  CHECK((momentum - mass * Eigen::Matrix3d::Identity()).norm() < 1e-8 * mass);
  CHECK(body.invariants.S2.rightCols<2>().norm() < 1e-6 * std::sqrt(mass));
  CHECK(body.orthogonality < 1e-9);
}

TEST_CASE("frequencies scale with stiffness, size and density, to the last bit") {
  // All factors are powers of two: every number of the computation scales without rounding.
  const auto frequencies = [](double young, double length, double density) {
    const mesher::Material material{"rubber", young, 0.49, density};
    const mesher::Mesh mesh =
        testing::box({2, 1, 3}, {0.05 * length, 0.04 * length, 0.1 * length}, material).make();
    return analyse_modes(mesh, fixed_at_bottom(5, 0.1 * length), {}).frequencies_Hz;
  };
  const Eigen::VectorXd base = frequencies(8e6, 1, 1000);
  constexpr double kRounding = 1e-12;  // tolerance for a library that applies a scale of its own
  const auto difference = [&](const Eigen::VectorXd& found, double factor) {
    return ((found - factor * base).array() / (factor * base).array()).abs().maxCoeff();
  };
  CHECK(difference(frequencies(32e6, 1, 1000), 2) < kRounding);
  CHECK(difference(frequencies(8e6, 2, 1000), 0.5) < kRounding);
  CHECK(difference(frequencies(8e6, 1, 4000), 0.5) < kRounding);
}

TEST_CASE("rubber bonded to a plate does not lock at a Poisson's ratio of 0.49") {
  // The pad is flat, fixed below and bonded to a steel plate above, which rocks on it. Twice as
  // many elements in each direction change the mixed frequency by less than 0.1 % and 0.2 % is
  // required; the displacement formulation starts 2.9 % too high and converges towards the same
  // value from above.
  constexpr double kTolerance = 2e-3;
  constexpr double kLocked = 2e-2;
  const auto pad = [](int refinement) {
    testing::BlockMesh block =
        testing::box({4 * refinement, 4 * refinement, 1}, {0.08, 0.08, 0.03}, {});
    block.slices = {{"pad", 2 * refinement, {"rubber", 8.3e6, 0.49, 950}},
                    {"plate", refinement, {"steel", 2.1e11, 0.3, 7850}}};
    return block.make();
  };
  const double coarse = lowest_frequency(pad(1), Formulation::mixed_pressure);
  const double fine = lowest_frequency(pad(2), Formulation::mixed_pressure);
  const double locked = lowest_frequency(pad(1), Formulation::displacement);
  const double less_locked = lowest_frequency(pad(2), Formulation::displacement);
  CHECK(std::abs(coarse / fine - 1) < kTolerance);
  CHECK(locked / fine - 1 > kLocked);
  CHECK(less_locked > fine);
  CHECK(less_locked - fine < (locked - fine) / 2);
}

TEST_CASE("a coarse cantilever bends alike at Poisson's ratios of 0 and 0.49") {
  // Bending stiffness is E I for any nu. Four long elements are 0.7 % too stiff for nu = 0; near
  // incompressibility the displacement formulation becomes 20 % too stiff, the mixed one does not.
  constexpr double kSide = 0.02, kLength = 0.4;
  const auto over_euler = [&](double nu, Formulation formulation) {
    const mesher::Material material{"rubber", 8e6, nu, 1000};
    const mesher::Mesh mesh = testing::box({1, 1, 4}, {kSide, kSide, kLength}, material).make();
    return lowest_frequency(mesh, formulation) / euler_cantilever(8e6, 1000, kSide, kLength);
  };
  const double reference = over_euler(0, Formulation::displacement);
  CHECK(std::abs(reference - 1) < 0.01);
  CHECK(std::abs(over_euler(0.49, Formulation::mixed_pressure) / reference - 1) < 0.005);
  CHECK(over_euler(0.49, Formulation::displacement) / reference - 1 > 0.15);
}

TEST_CASE("the fixed interface does not move, and shapes are zero where nodes are fixed") {
  const mesher::Mesh mesh = testing::box({1, 1, 3}, {0.05, 0.05, 0.3}, kSteel).make();
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(4, 0.3), {});
  const Interface& root = body.interface("root");
  CHECK(root.position_m == Eigen::Vector3d(0.01, 0.02, 0));
  CHECK(root.translation == Eigen::Matrix3Xd::Zero(3, 4));
  CHECK(root.rotation == Eigen::Matrix3Xd::Zero(3, 4));
  for (const Eigen::Matrix3Xd& shape : body.shapes) {
    for (const std::int32_t node : mesh.node_set("bottom").nodes) {
      CHECK(shape.col(node) == Eigen::Vector3d::Zero());
    }
  }
  CHECK(body.boundary == "fixed: bottom");
  CHECK(body.completeness == "not checked");
  CHECK(body.nodes_m.cols() == static_cast<Eigen::Index>(mesh.nodes.size()));
}

TEST_CASE("what rounding takes from a frequency near Poisson's ratio 1/2 is known to a per cent") {
  const auto bar = [](double poissons_ratio) {
    return testing::box({1, 1, 6}, {0.02, 0.03, 0.5}, {"rubber", 7e10, poissons_ratio, 2700})
        .make();
  };
  const auto solved = [&](double poissons_ratio) {
    return analyse_modes(bar(poissons_ratio), fixed_at_bottom(1, 0.5), {});
  };
  // The frequency is analytic in 1 - 2 nu: these two values give the limit to 1e-8.
  const ModalBody soft = solved(0.499);
  CHECK(rounding_error(bar(0.499), {}, soft) < 1e-6);
  const double limit = (10 * solved(0.4999).frequencies_Hz[0] - soft.frequencies_Hz[0]) / 9;
  const ModalBody stiff = solved(0.499999999);
  const double lost = std::abs(stiff.frequencies_Hz[0] - limit) / limit;
  CHECK(lost > 1e-5);
  CHECK(rounding_error(bar(0.499999999), {}, stiff) == Approx(lost).epsilon(0.05));
}

}  // namespace flexneck::fe_modal
