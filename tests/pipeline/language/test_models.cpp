// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped model files, compared with the built-in experiments and with independently known
// results.
#include <array>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_reading.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::History;
using testing::run;

namespace {

/// Two ways to define the same model differ only by rounding of the input.
constexpr double kSame = 1e-12;

std::string shipped(const std::string& name) {
  return std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/models/" + name;
}

/// The built-in study with the modes of the same beam.
struct BuiltIn {
  Study study = read_study(built_in_study(), {});
  fe_modal::ModalBody body = testing::make_beam_body(testing::Beam());
  const CaseSection& named(const std::string& name) const {
    for (const CaseSection& each : study.cases)
      if (each.name == name) return each;
    throw std::runtime_error("no case " + name);
  }
};

/// Compares markers and reactions, each relative to its largest value.
void check_same(const History& found, const History& expected) {
  REQUIRE(found.time_s.size() == expected.time_s.size());
  REQUIRE(found.markers.size() == expected.markers.size());
  const auto check = [](const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
    CHECK((left - right).cwiseAbs().maxCoeff() <=
          kSame * std::max(1.0, right.cwiseAbs().maxCoeff()));
  };
  for (const multibody::MarkerHistory& marker : expected.markers) {
    CAPTURE(marker.name);
    const multibody::MarkerHistory& same = found.marker(marker.name);
    check(same.position_m, marker.position_m);
    check(same.velocity_m_s, marker.velocity_m_s);
    check(same.acceleration_m_s2, marker.acceleration_m_s2);
    check(same.angular_velocity_rad_s, marker.angular_velocity_rad_s);
  }
  for (const multibody::JointHistory& joint : expected.joints) {
    CAPTURE(joint.name);
    check(found.joint(joint.name).force_N, joint.force_N);
    check(found.joint(joint.name).moment_Nm, joint.moment_Nm);
  }
}

}  // namespace

TEST_CASE("the shipped pendulum is the built-in experiment") {
  const TemporaryFolder folder;
  testing::write_beam_modes(folder / "modes.h5");
  const ModelFile file = read_model_file(
      shipped("pendulum.toml"),
      {"body.neck.modes_file=" + (folder / "modes.h5").string(), "solver.end_time=60 ms"});
  const BuiltIn built_in;
  check_same(run(file),
             multibody::simulate_from_equilibrium(
                 pendulum_model(built_in.study, built_in.named("flexion-120"), built_in.body),
                 built_in.study.solver, {0.06, file.output.interval_s}));
}

TEST_CASE("the shipped static test is the built-in experiment") {
  const TemporaryFolder folder;
  testing::write_beam_modes(folder / "modes.h5");
  const ModelFile file = read_model_file(
      shipped("static_test.toml"),
      {"body.neck.modes_file=" + (folder / "modes.h5").string(), "solver.end_time=0.5 s"});
  const BuiltIn built_in;
  check_same(run(file), multibody::simulate(case_model(built_in.named("flexion"), built_in.body),
                                            built_in.study.solver, {0.5, file.output.interval_s}));
}

TEST_CASE("the shipped static test as a quasi-static ramp shows K^-1 f of its modes at each load") {
  const TemporaryFolder folder;
  testing::write_beam_modes(folder / "modes.h5");
  const ModelFile file = read_model_file(
      shipped("static_test.toml"), {"body.neck.modes_file=" + (folder / "modes.h5").string(),
                                    "solver.analysis=quasi_static", "output.interval=0.25 s"});
  REQUIRE(file.analysis == ModelFile::Analysis::quasi_static);
  const History history =
      multibody::settle(file.model, file.solver, {file.end_time_s, file.output.interval_s});
  const auto& body =
      std::get<multibody::DeformableBody>(file.model.bodies[file.model.body_index("neck")].kind)
          .modes;
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  const Eigen::Matrix3Xd psi = body.interface("top").translation;
  const Eigen::Matrix3d compliance =
      psi * omega.cwiseAbs2().cwiseInverse().asDiagonal() * psi.transpose();
  const Eigen::Vector3d rest = body.interface("top").position_m;
  REQUIRE(history.time_s.size() == 9);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const Eigen::Vector3d load(400 * 4.4482216152605 * history.time_s[k] / 2, 0, 0);
    const Eigen::Vector3d top = history.marker("neck.top").position_m.col(k);
    CHECK((top - rest - compliance * load).norm() < 1e-9);
    CHECK((history.joint("clamp").force_N.col(k) + load).norm() < 1e-8 * (1 + load.norm()));
    CHECK((history.joint("clamp").moment_Nm.col(k) + top.cross(load)).norm() <
          1e-8 * (1 + load.norm()));
    CHECK(history.energy.work_J[k] == Approx(load.dot(compliance * load) / 2).margin(1e-9));
  }
}

TEST_CASE("the shipped chain balances its energy, and its joints carry what hangs on them") {
  const TemporaryFolder folder;
  testing::Beam seat_back;
  seat_back.length_m = 0.6;
  seat_back.mass_kg = 8;
  testing::write_beam_modes(folder / "seat_back.h5", seat_back, "feet", "head_rail");
  testing::write_beam_modes(folder / "modes.h5");
  const ModelFile file = read_model_file(
      shipped("chain.toml"),
      {"body.seat_back.modes_file=" + (folder / "seat_back.h5").string(),
       "body.neck.modes_file=" + (folder / "modes.h5").string(), "output.interval=1 ms",
       "channel.sled.filter=CFC 60", "channel.head acceleration.filter=CFC 60",
       "channel.occipital moment.filter=CFC 60"});
  const History history = run(file);
  const multibody::EnergyHistory& energy = history.energy;
  const Eigen::VectorXd balance = energy.kinetic_J + energy.gravitational_J + energy.strain_J +
                                  energy.dissipated_J - energy.work_J;
  CHECK((balance.array() - balance[0]).abs().maxCoeff() <
        1e-6 * energy.work_J.cwiseAbs().maxCoeff());
  // At rest the feet carry all weight above them, and the neck's top the head's.
  const double head_N = 9.921 * 0.45359237 * 9.80665;
  CHECK(history.joint("occipital").force_N.col(0).norm() == Approx(head_N).epsilon(1e-9));
  CHECK(history.joint("feet").force_N.col(0).norm() ==
        Approx(head_N + (12 + 8 + 1.21) * 9.80665).epsilon(1e-9));
  // The head lags behind the sled, which is accelerated forward.
  const Eigen::VectorXd lag =
      (history.marker("head.cg").position_m.row(0) - history.marker("sled.floor").position_m.row(0))
          .transpose();
  CHECK(lag.minCoeff() < lag[0] - 0.02);
}

TEST_CASE("the shipped four-bar closes its loop and names what is held twice") {
  const ModelFile file = read_model_file(shipped("four_bar.toml"), {"solver.end_time=0.3 s"});
  const History history = run(file);
  CHECK(history.redundant_constraints.size() == 3);
  CHECK(history.statistics.max_position_residual < 1e-12);
  const multibody::EnergyHistory& energy = history.energy;
  const Eigen::VectorXd balance = energy.kinetic_J + energy.gravitational_J + energy.strain_J +
                                  energy.dissipated_J - energy.work_J;
  CHECK((balance.array() - balance[0]).abs().maxCoeff() <
        1e-7 * energy.work_J.cwiseAbs().maxCoeff());
}

TEST_CASE("the shipped squeezing mechanism ends where the published solution does") {
  const ModelFile file = read_model_file(shipped("andrews.toml"), {});
  const History history = run(file);
  // beta, Theta, gamma, phi, delta, Omega, epsilon at 30 ms, from the test set for initial value
  // problems.
  constexpr std::array kPublished = {15.81077119629904,   -15.75637105984298, 0.04082224013073101,
                                     -0.5347301163226948, 0.5244099658805304, 0.5347301163226948,
                                     1.048080741042263};
  std::array<double, 7> K{};
  for (std::size_t k = 0; k < K.size(); ++k) {
    const multibody::Channel angle =
        channel_of(history, file.output.channels[k], file.model.gravity_m_s2);
    K[k] = angle.values(0, angle.values.cols() - 1);
  }
  const std::array found = {K[0], K[1] - K[0], K[2], K[3] - K[4], K[4], K[5] - K[6], K[6]};
  for (std::size_t k = 0; k < found.size(); ++k) {
    CAPTURE(k);
    CHECK(found[k] == Approx(kPublished[k]).epsilon(1e-8));
  }
  CHECK(history.redundant_constraints.size() == 9);
  CHECK(history.constraints.position_m.maxCoeff() < 1e-13);
}
