// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/dofs/rigid_mass.h"
#include "fe_modal/solve/attached_mass.h"
#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

Eigen::Matrix3d full_inertia() {
  Eigen::Matrix3d inertia;
  inertia << 0.020, 0.002, -0.001, 0.002, 0.024, 0.003, -0.001, 0.003, 0.018;
  return inertia;
}

/// Number of times that PETSc or SLEPc has logged an event.
int calls_of(const char* event) {
  PetscLogEvent id = -1;
  PetscEventPerfInfo info{};
  require(PetscLogEventGetId(event, &id), "asking for an event");
  if (id < 0) return 0;  // SLEPc registers its events when it is first used
  require(PetscLogEventGetPerfInfo(0, id, &info), "asking for an event");
  return info.count;
}

}  // namespace

TEST_CASE("the mass matrix of a rigid body is that of its particles") {
  // The kinetic energy of eight particles is compared with 1/2 v^T M v.
  const Eigen::Vector3d center(0.1, -0.2, 0.3);
  double mass = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::vector<std::pair<double, Eigen::Vector3d>> particles;
  for (int k = 0; k < 8; ++k) {
    const double m = 0.5;
    const Eigen::Vector3d r(k & 1 ? 0.1 : -0.1, k & 2 ? 0.2 : -0.2, k & 4 ? 0.05 : -0.05);
    particles.emplace_back(m, center + r);
    mass += m;
    inertia += m * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  Vector6d v;
  v << 0.3, -0.2, 0.7, 1.1, -0.4, 0.6;
  double energy = 0;
  for (const auto& [m, r] : particles) {
    energy += m / 2 * (v.head<3>() + v.tail<3>().cross(r)).squaredNorm();
  }
  CHECK(v.dot(rigid_mass_matrix(mass, center, inertia) * v) / 2 == Approx(energy).epsilon(1e-13));
}

TEST_CASE("frequencies with a body attached agree with a dense solution") {
  constexpr double kTolerance = 1e-9;
  const mesher::Mesh mesh =
      testing::box({2, 1, 2}, {0.1, 0.08, 0.2}, {"rubber", 8.3e6, 0.49, 950}).make();
  const Eigen::Vector3d point(0.01, -0.01, 0.2);
  const Eigen::Vector3d center(0.03, 0.01, 0.25);
  ModalOptions options;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", point}};
  options.attachments = {{"head", "tip", 4.5, center, full_inertia()}};

  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const auto weights =
      RigidAverage(mesh, mesh.face_set("top"), point).weights(dof_map.node_count());
  Eigen::MatrixXd average(6, dof_map.dof_count());
  for (std::size_t i = 0; i < 6; ++i) {
    average.row(static_cast<Eigen::Index>(i)) = dof_map.gather(weights[i]).transpose();
  }
  const Eigen::MatrixXd mass =
      dense(system.mass.get()) +
      average.transpose() * rigid_mass_matrix(4.5, center - point, full_inertia()) * average;
  const Eigen::VectorXd expected =
      testing::dense_pairs(dense(system.stiffness.get()), mass).values.head(6).cwiseSqrt() /
      (2 * std::numbers::pi);
  // With few modes a search of its own is made, with more the frequencies come from the modes'
  // span, and with all modes nothing is left beside the span.
  for (const int count : {3, 6, 10, static_cast<int>(dof_map.dof_count())}) {
    options.mode_count = count;
    const ModalBody body = analyse_modes(mesh, options, {});
    REQUIRE(body.attached.size() == 1);
    CHECK(body.attached[0].body == "head");
    CHECK(body.attached[0].interface == "tip");
    const Eigen::VectorXd& found = body.attached[0].frequencies_Hz;
    REQUIRE(found.size() == 6);
    CAPTURE(count);
    CHECK(((found - expected).array() / expected.array()).abs().maxCoeff() < kTolerance);
    CHECK(found[0] < body.frequencies_Hz[0]);
  }
}

TEST_CASE("modes with a body attached are SLEPc's, by the one factor that PETSc makes") {
  const mesher::Mesh mesh =
      testing::box({2, 1, 3}, {0.1, 0.08, 0.2}, {"rubber", 8.3e6, 0.49, 950}).make();
  ModalOptions options;
  options.mode_count = 4;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, 0.2}}};
  options.attachments = {{"head", "tip", 4.5, {0.03, 0.01, 0.25}, full_inertia()}};
  require(PetscLogDefaultBegin(), "counting events");
  const auto counts = [] {
    return std::array<int, 4>{calls_of("EPSSolve"), calls_of("MatCholFctrNum"),
                              calls_of("MatSolve"), calls_of("MatMatSolve")};
  };
  const std::array<int, 4> before = counts();
  const ModalBody body = analyse_modes(mesh, options, {});
  std::array<int, 4> calls = counts();
  for (std::size_t k = 0; k < calls.size(); ++k) calls[k] -= before[k];
  CHECK(calls[0] == 4);  // modes, modes with the head, and for each a check for missing ones
  CHECK(calls[1] == 1);
  CAPTURE(body.solver);
  CHECK_THAT(body.solver, Catch::EndsWith("; " + std::to_string(calls[2]) + " solves, " +
                                          std::to_string(calls[3]) + " of blocks"));
}

TEST_CASE("a heavy body on a light cantilever swings as the beam's two tip springs tell") {
  // The plane is that of x and z: tip flexibility of a beam with shear, [L^3/3EI + L/kGA, L^2/2EI;
  // ., L/EI], mass and inertia of the body at a distance from the tip. nu = 0, so the clamp adds no
  // stiffness. Expected deviation: beam mass (1e-6 of the body's) 1e-6, shear coefficient 5/6 (of a
  // share of 0.2 %) and discretisation a few 1e-5.
  constexpr double kTolerance = 2e-4;
  constexpr double kSide = 0.02, kLength = 0.4, kYoung = 2.1e11;
  constexpr double kMass = 2.0, kInertia = 0.004, kArm = 0.05;
  const mesher::Mesh mesh =
      testing::box({2, 2, 20}, {kSide, kSide, kLength}, {"light", kYoung, 0, 0.0125}).make();
  ModalOptions options;
  options.mode_count = 1;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, kLength}}};
  options.attachments = {{"mass",
                          "tip",
                          kMass,
                          {0, 0, kLength + kArm},
                          Eigen::Vector3d(0.006, kInertia, 0.001).asDiagonal()}};
  const ModalBody body = analyse_modes(mesh, options, {});

  const double EI = kYoung * std::pow(kSide, 4) / 12;
  const double kGA = 5.0 / 6 * kYoung / 2 * kSide * kSide;
  Eigen::Matrix2d flexibility;  // map from (F_x, M_y) to (x, theta_y)
  flexibility << std::pow(kLength, 3) / (3 * EI) + kLength / kGA, kLength * kLength / (2 * EI),
      kLength * kLength / (2 * EI), kLength / EI;
  Eigen::Matrix2d mass;
  mass << kMass, kMass * kArm, kMass * kArm, kInertia + kMass * kArm * kArm;
  const Eigen::Vector2d plane =
      testing::dense_pairs(flexibility.inverse(), mass).values.cwiseSqrt() / (2 * std::numbers::pi);
  const Eigen::VectorXd& found = body.attached.at(0).frequencies_Hz;
  for (const double expected : plane) {
    CHECK((found.array() / expected - 1).abs().minCoeff() < kTolerance);
  }
}

}  // namespace flexneck::fe_modal
