// SPDX-License-Identifier: GPL-3.0-or-later
// A modal body whose root is fixed obeys linear equations, however large its motion: closed forms.
#include <cmath>
#include <complex>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kForce_N = 400;

Beam twisting_beam() {
  Beam beam;
  beam.twist_modes = 1;
  return beam;
}

/// The beam on the ground (or on a prescribed base), with a force on its top.
ModelBuilder held_beam(const flexneck::fe_modal::ModalBody& body, double zeta,
                       const PrescribedBody& base = {}) {
  ModelBuilder build;
  const Vector3d velocity = base.initial_velocity_m_s * base.direction;
  const auto ground = build.body("base", base);
  const auto beam = build.body("beam", deformable(body, zeta), {}, velocity);
  const auto holder = build.marker("holder", ground);
  build.joint("root", &kFixedJoint, holder, build.interface_marker("foot", beam, "base"));
  build.interface_marker("top", beam, "top");
  return build;
}

/// Unit step response of a'' + 2 zeta w a' + w^2 a = 1 at time t, for any zeta but 1.
double step_response(double w, double zeta, double t) {
  using Complex = std::complex<double>;
  const Complex root = w * std::sqrt(Complex(zeta * zeta - 1));
  const Complex p = -zeta * w + root;
  const Complex q = -zeta * w - root;
  return ((1.0 + (q * std::exp(p * t) - p * std::exp(q * t)) / (p - q)) / (w * w)).real();
}

}  // namespace

TEST_CASE("A sudden force sets each mode swinging as its closed form says") {
  const double zeta = GENERATE(0.0, 0.05, 0.9, 1.3);
  const auto body = make_beam_body(twisting_beam());
  ModelBuilder build = held_beam(body, zeta);
  const Vector3d direction = Vector3d(1, -0.7, 0.2).normalized();
  build.force("push", build.model.marker_index("top"), direction, constant_table(kForce_N));
  const History history =
      simulate(build.model, tight_solver(), {.end_time_s = 0.1, .interval_s = 5e-4});
  const Eigen::MatrixXd& a = history.modal[0].coordinates;
  const Eigen::VectorXd load = kForce_N * body.interface("top").translation.transpose() * direction;
  REQUIRE(a.cols() == 201);
  for (Eigen::Index mode = 0; mode < a.rows(); ++mode) {
    const double w = 2 * kPi * body.frequencies_Hz[mode];
    const double scale = std::abs(load[0]) / std::pow(2 * kPi * body.frequencies_Hz[0], 2);
    double error = 0;
    double error_of_other_damping = 0;
    for (Eigen::Index k = 0; k < a.cols(); ++k) {
      const double t = history.time_s[k];
      const double found = a(mode, k);
      error = std::max(error, std::abs(found - load[mode] * step_response(w, zeta, t)));
      error_of_other_damping = std::max(
          error_of_other_damping, std::abs(found - load[mode] * step_response(w, 1.01 * zeta, t)));
    }
    constexpr double kTolerance = 1e-8;
    CHECK(error < kTolerance * scale);
    // The comparison is sharp: one per cent of damping is far outside.
    if (zeta > 0 && load[mode] != 0) CHECK(error_of_other_damping > 100 * kTolerance * scale);
  }
}

TEST_CASE("A force that rises slowly bends the body by the inverse of its stiffness") {
  const double zeta = 0.9;
  constexpr double kRise_s = 2;
  const auto body = make_beam_body(twisting_beam());
  const Eigen::Matrix3Xd& top = body.interface("top").translation;
  const Eigen::VectorXd stiffness = (2 * kPi * body.frequencies_Hz.array()).square();
  ModelBuilder build = held_beam(body, zeta);
  build.force("push", build.model.marker_index("top"), {1, 0, 0},
              TimeTable({0, kRise_s}, {0, kForce_N}, TimeTable::Outside::constant));
  const History history =
      simulate(build.model, tight_solver(), {.end_time_s = kRise_s, .interval_s = 0.5});
  for (const Eigen::Index k : {2, 3, 4}) {
    // A damped ramp lags by 2 zeta / w in each mode once the start has died away.
    const double t = history.time_s[k];
    const Eigen::ArrayXd lag = 2 * zeta / stiffness.array().sqrt();
    const Eigen::VectorXd a =
        (kForce_N / kRise_s * (t - lag) * top.row(0).transpose().array() / stiffness.array());
    const Vector3d expected = body.interface("top").position_m + top * a;
    CHECK((history.marker("top").position_m.col(k) - expected).norm() < 1e-9);
    // The base carries the force and its moment about the held point.
    const Vector3d force = kForce_N * t / kRise_s * Vector3d::UnitX();
    const JointHistory& root = history.joint("root");
    CHECK((root.force_N.col(k) + force).norm() < 1e-6 * kForce_N);
    CHECK((root.moment_Nm.col(k) + expected.cross(force)).norm() < 1e-6 * kForce_N);
  }
}

TEST_CASE("A run from equilibrium starts at K^-1 f with the reactions of statics and stays there") {
  const auto body = make_beam_body(twisting_beam());
  const Eigen::Matrix3Xd& top = body.interface("top").translation;
  const Eigen::VectorXd stiffness = (2 * kPi * body.frequencies_Hz.array()).square();
  ModelBuilder build = held_beam(body, 0.1);
  const Vector3d force(kForce_N, 100, -30);
  build.force("push", build.model.marker_index("top"), force, constant_table(force.norm()));
  const History history = simulate_from_equilibrium(build.model, tight_solver(),
                                                    {.end_time_s = 0.02, .interval_s = 0.01});
  const Eigen::VectorXd a = (top.transpose() * force).array() / stiffness.array();
  const Vector3d expected = body.interface("top").position_m + top * a;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    CHECK((history.modal[0].coordinates.col(k) - a).norm() < 1e-9 * a.norm());
    CHECK((history.marker("top").position_m.col(k) - expected).norm() < 1e-10);
    CHECK((history.joint("root").force_N.col(k) + force).norm() < 1e-7 * force.norm());
    CHECK((history.joint("root").moment_Nm.col(k) + expected.cross(force)).norm() <
          1e-7 * force.norm());
  }
}

TEST_CASE("A prescribed base excites the modes by their first moments") {
  // a'' + 2 zeta w a' + w^2 a = -S2 . acceleration; a jump of the acceleration is a step.
  const double zeta = 0.2;
  constexpr double kAcceleration = -50;
  constexpr double kSpeed = 3;
  const auto body = make_beam_body({});
  const Vector3d direction = Vector3d(2, 1, 0.5).normalized();
  const PrescribedBody base{direction, kSpeed, constant_table(kAcceleration)};
  const History history = simulate(held_beam(body, zeta, base).model, tight_solver(),
                                   {.end_time_s = 0.1, .interval_s = 1e-3});
  const Eigen::VectorXd load = -kAcceleration * body.invariants.S2.transpose() * direction;
  const double scale = load.cwiseAbs().maxCoeff() / std::pow(2 * kPi * 36.1, 2);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    for (Eigen::Index mode = 0; mode < load.size(); ++mode) {
      const double expected =
          load[mode] * step_response(2 * kPi * body.frequencies_Hz[mode], zeta, t);
      CHECK(std::abs(history.modal[0].coordinates(mode, k) - expected) < 1e-8 * scale);
    }
    const Vector3d holder = (kSpeed * t + kAcceleration * t * t / 2) * direction;
    CHECK((history.marker("holder").position_m.col(k) - holder).norm() < 1e-14);
    CHECK((history.marker("foot").position_m.col(k) - holder).norm() < 1e-10);
  }
}

TEST_CASE("A body made elsewhere moves the same when it comes from a file") {
  const flexneck::TemporaryFolder folder;
  const auto made = make_beam_body(twisting_beam());
  flexneck::Provenance provenance;
  provenance.program = "another program";
  provenance.git_hash = "unknown";
  flexneck::fe_modal::write_modal_body(folder / "beam.h5", {made, provenance});
  const auto read = flexneck::fe_modal::read_modal_body(folder / "beam.h5").body;
  const auto run = [](const flexneck::fe_modal::ModalBody& body) {
    ModelBuilder build = held_beam(body, 0.3);
    build.force("push", build.model.marker_index("top"), {1, 1, 1}, constant_table(kForce_N));
    return simulate(build.model, {}, {.end_time_s = 0.05, .interval_s = 0.01});
  };
  const History from_memory = run(made);
  const History from_file = run(read);
  CHECK(from_file.modal[0].modes == from_memory.modal[0].modes);
  CHECK(from_file.modal[0].coordinates == from_memory.modal[0].coordinates);
  CHECK(from_file.marker("top").position_m == from_memory.marker("top").position_m);
}
