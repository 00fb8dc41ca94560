// SPDX-License-Identifier: GPL-3.0-or-later
// A beam that stiffens by spin and softens under compression, compared with closed forms
// (equations.md section 3a). The beam's geometric stiffness is that of an inextensible one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/signals/response.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck;
using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Ratio of the hub's inertia to that of the beam about the hub: to this accuracy its motion is
/// prescribed.
constexpr double kHeaviness = 1e9;

DeformableBody elastic(const Beam& beam, bool stiffens) {
  DeformableBody body = deformable(make_beam_body(beam), 0);
  body.stress_stiffening = stiffens;
  return body;
}

/// Ground – pin about y – hub – beam along z, and the hub's marker.
struct SpunBeam {
  ModelBuilder build;
  double hub_inertia_kg_m2;
  std::size_t hub;
  std::size_t tip;
};

SpunBeam spun_beam(const Beam& beam, bool stiffens, double spin_rad_s,
                   double heaviness = kHeaviness) {
  SpunBeam spun;
  spun.hub_inertia_kg_m2 = heaviness * beam.mass_kg * beam.length_m * beam.length_m / 3;
  ModelBuilder& build = spun.build;
  const Vector3d rate = spin_rad_s * Vector3d::UnitY();
  const auto ground = build.ground();
  const auto hub = build.body(
      "hub", RigidBody{1, Vector3d::Zero(), spun.hub_inertia_kg_m2 * Eigen::Matrix3d::Identity()},
      {}, Vector3d::Zero(), rate);
  const auto arm = build.body("beam", elastic(beam, stiffens), {}, Vector3d::Zero(), rate);
  spun.hub = build.marker("hub", hub);
  build.joint("pin", &kRevoluteJoint, build.marker("ground", ground), spun.hub, Vector3d::UnitY());
  build.joint("root", &kFixedJoint, spun.hub, build.interface_marker("root", arm, "base"));
  spun.tip = build.interface_marker("tip", arm, "top");
  return spun;
}

/// Integrals int (L^2 - z^2) / 2 w_j' w_l' over the masses of mass-normalised bending shapes, by an
/// independent quadrature: Southwell's coefficient if j is l.
MatrixXd southwell(std::size_t count) {
  const auto [points, weights] = gauss_rule(60);
  const auto n = static_cast<Index>(count);
  MatrixXd sum = MatrixXd::Zero(n, n);
  VectorXd slopes(n);
  for (Index k = 0; k < points.size(); ++k) {
    for (std::size_t l = 0; l < count; ++l)
      slopes[static_cast<Index>(l)] = clamped_free_shape(l, points[k]).second;
    sum += weights[k] * (1 - points[k] * points[k]) / 2 * slopes * slopes.transpose();
  }
  return sum;
}

/// Mean frequency over all cycles of the record.
double mean_frequency_Hz(const History& history, Index mode) {
  const VectorXd signal = history.modal[0].coordinates.row(mode).transpose();
  const FreeOscillation found = free_oscillation(history.time_s, signal, 0, 0.01);
  const auto& crossings = found.crossings_s;
  REQUIRE(crossings.size() > 8);
  return 0.5 * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

/// The beam of Kane, Ryan and Banerjee's spin-up: slender, with a first mode slower than the spin.
struct SpinUp {
  double length_m = 8;
  double linear_density_kg_m = 0.2019;
  double bending_stiffness_Nm2 = 566.7;
  double final_spin_rad_s = 6;
  double duration_s = 15;
  int modes = 3;

  Beam beam() const {
    Beam beam;
    beam.length_m = length_m;
    beam.mass_kg = linear_density_kg_m * length_m;
    beam.gyration_m = 0.3;  // does not matter in the plane, but a line has no inertia about itself
    beam.fore_aft_modes = modes;
    beam.lateral_modes = 0;
    const double x = kClampedFree[0];
    beam.fore_aft_Hz = x * x * std::sqrt(bending_stiffness_Nm2 / linear_density_kg_m) /
                       (length_m * length_m * 2 * std::numbers::pi);
    return beam;
  }
  double spin_rad_s(double t) const {
    const double phase = 2 * std::numbers::pi / duration_s;
    return t < duration_s ? final_spin_rad_s / duration_s * (t - std::sin(phase * t) / phase)
                          : final_spin_rad_s;
  }
  double spin_rate_rad_s2(double t) const {
    const double phase = 2 * std::numbers::pi / duration_s;
    return t < duration_s ? final_spin_rad_s / duration_s * (1 - std::cos(phase * t)) : 0;
  }
};

/// Solution of a'' + (omega^2 + spin^2 (K - 1)) a = -spin' int z w, the textbook's equation of the
/// spinning beam, by Runge and Kutta's method; one column every `interval_s`.
MatrixXd textbook_spin_up(const SpinUp& law, double end_s, double interval_s) {
  const auto n = static_cast<Index>(law.modes);
  const Beam beam = law.beam();
  const MatrixXd K = southwell(static_cast<std::size_t>(law.modes)) - MatrixXd::Identity(n, n);
  VectorXd squares(n);
  VectorXd moments(n);
  const auto [points, weights] = gauss_rule(60);
  for (Index l = 0; l < n; ++l) {
    const auto number = static_cast<std::size_t>(l);
    const double ratio = std::pow(kClampedFree[number] / kClampedFree[0], 2);
    squares[l] = std::pow(2 * std::numbers::pi * beam.fore_aft_Hz * ratio, 2);
    moments[l] = 0;
    for (Index k = 0; k < points.size(); ++k)
      moments[l] += weights[k] * points[k] * clamped_free_shape(number, points[k]).first;
    moments[l] *= std::sqrt(beam.mass_kg) * beam.length_m;
  }
  const auto rate = [&](double t, const VectorXd& y) {
    const double spin = law.spin_rad_s(t);
    VectorXd result(2 * n);
    result.head(n) = y.tail(n);
    result.tail(n) = -squares.cwiseProduct(y.head(n)) - spin * spin * (K * y.head(n)) -
                     law.spin_rate_rad_s2(t) * moments;
    return result;
  };
  constexpr int kSteps = 200;  // in an interval of 0.1 s: an error of 1e-9
  const double h = interval_s / kSteps;
  const auto count = static_cast<Index>(std::lround(end_s / interval_s));
  MatrixXd columns = MatrixXd::Zero(n, count + 1);
  VectorXd y = VectorXd::Zero(2 * n);
  for (Index c = 0; c < count; ++c) {
    for (int k = 0; k < kSteps; ++k) {
      const double t = static_cast<double>(c) * interval_s + k * h;
      const VectorXd k1 = rate(t, y);
      const VectorXd k2 = rate(t + h / 2, y + h / 2 * k1);
      const VectorXd k3 = rate(t + h / 2, y + h / 2 * k2);
      const VectorXd k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    columns.col(c + 1) = y.head(n);
  }
  return columns;
}

/// Run in which the hub is driven by the torque that its inertia requires, as a table.
History spin_up(const SpinUp& law, bool stiffens, const OutputOptions& output) {
  SpunBeam spun = spun_beam(law.beam(), stiffens, 0, 1e6);
  std::vector<double> times;
  std::vector<double> torques;
  constexpr int kRows = 3000;
  for (int k = 0; k <= kRows; ++k) {
    times.push_back(law.duration_s * k / kRows);
    torques.push_back(spun.hub_inertia_kg_m2 * law.spin_rate_rad_s2(times.back()));
  }
  spun.build.model.forces.add(Torque{"motor", spun.hub, Vector3d::UnitY(),
                                     TimeTable(times, torques, TimeTable::Outside::zero)});
  return simulate(spun.build.model, solver_of(1e-9, 1e-12), output);
}

/// Square of the lowest frequency of a clamped-free column under a dead load p = P L^2 / EI, in
/// units of EI / (m L^3): a root of the determinant of its two end conditions.
double pressed_column_square(double p) {
  const auto determinant = [p](double square) {
    const double root = std::sqrt(p * p / 4 + square);
    const double a = std::sqrt(root - p / 2);
    const double b = std::sqrt(root + p / 2);
    // w = A (cosh az - cos bz) + B (sinh az / a - sin bz / b); w'' = 0, w''' + p w' = 0 at the end.
    const double ch = std::cosh(a);
    const double sh = std::sinh(a);
    const double c = std::cos(b);
    const double s = std::sin(b);
    const double A2 = a * a * ch + b * b * c;
    const double B2 = a * sh + b * s;
    const double A3 = a * a * a * sh - b * b * b * s + p * (a * sh + b * s);
    const double B3 = a * a * ch + b * b * c + p * (ch - c);
    return A2 * B3 - A3 * B2;
  };
  double low = 1e-9;
  double high = 12.4 + 8 * std::max(0.0, -p);  // above that of the free column, 12.362, or pulled
  REQUIRE(determinant(low) * determinant(high) < 0);
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (determinant(low) * determinant(middle) > 0 ? low : high) = middle;
  }
  return low;
}

/// A column with a dead load at its top.
Model column(int modes, bool stiffens, double load_N) {
  Beam beam;
  beam.fore_aft_modes = modes;
  beam.lateral_modes = 0;
  ModelBuilder build;
  const auto ground = build.ground();
  const auto post = build.body("column", elastic(beam, stiffens));
  build.joint("clamp", &kFixedJoint, build.marker("ground", ground),
              build.interface_marker("foot", post, "base"));
  build.force("load", build.interface_marker("top", post, "top"), -Vector3d::UnitZ(),
              constant_table(load_N));
  return build.model;
}

double first_square(const Model& model) {
  return std::pow(2 * std::numbers::pi * system_modes(model)[0].frequency_Hz, 2);
}

}  // namespace

TEST_CASE("a spun beam stiffens by Southwell's coefficient across its plane, by one less in it") {
  Beam beam;
  beam.fore_aft_modes = beam.lateral_modes = 1;
  beam.fore_aft_Hz = beam.lateral_Hz = 10;
  const double phi = southwell(1)(0, 0);
  REQUIRE(phi == Approx(1.193).margin(5e-4));  // the textbooks' coefficient
  const double spin_Hz = GENERATE(0.0, 3.0, 15.0);
  SpunBeam spun = spun_beam(beam, true, 2 * std::numbers::pi * spin_Hz);
  spun.build.force("strike", spun.tip, {1, 1, 0},
                   TimeTable({0, 0.001, 0.002}, {0, 1, 0}, TimeTable::Outside::zero));
  const History history =
      simulate(spun.build.model, solver_of(1e-10, 1e-13), {.end_time_s = 2, .interval_s = 1e-3});
  REQUIRE(history.modal[0].modes[0] == "fore-aft bending 1");
  // The hub moves by 1 / kHeaviness; crossings are interpolated over 1 ms of some tens of cycles,
  // an error of less than 2e-6.
  CHECK(mean_frequency_Hz(history, 0) ==
        Approx(std::sqrt(100 + (phi - 1) * spin_Hz * spin_Hz)).epsilon(4e-6));
  CHECK(mean_frequency_Hz(history, 1) ==
        Approx(std::sqrt(100 + phi * spin_Hz * spin_Hz)).epsilon(4e-6));
}

TEST_CASE(
    "Kane's beam lags behind its hub as it spins up and comes back, and a linear one is stopped") {
  const SpinUp law;
  const OutputOptions output{.end_time_s = 20, .interval_s = 0.1};
  const History history = spin_up(law, true, output);
  const MatrixXd expected = textbook_spin_up(law, output.end_time_s, output.interval_s);
  const MatrixXd& found = history.modal[0].coordinates;
  REQUIRE(found.cols() == expected.cols());
  // The beam's own second order enters only through the hub, which moves by 1e-6; the torque's
  // table has an error of (5 ms)^2 / 8 of its curvature, 5e-7 of its largest value.
  CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-5 * expected.cwiseAbs().maxCoeff());
  const double tip_m = 2 / std::sqrt(law.beam().mass_kg) * expected.row(0).cwiseAbs().maxCoeff();
  CHECK(tip_m > 0.5);  // of 8 m
  // Once the spin is steady it only oscillates about the radial line.
  CHECK(found.rightCols(50).cwiseAbs().maxCoeff() < 0.02 * found.cwiseAbs().maxCoeff());
  // The first mode is slower than the spin: a linear body has a negative stiffness and diverges.
  try {
    spin_up(law, false, output);
    FAIL("a beam that runs away was not stopped");
  } catch (const IncompleteRun& stopped) {
    const MatrixXd& kept = stopped.history.modal[0].coordinates;
    REQUIRE(kept.cols() == stopped.history.time_s.size());
    CHECK(kept.cols() < found.cols());
    CHECK(kept.col(kept.cols() - 1).norm() > 10 * expected.col(kept.cols() - 1).norm());
    CHECK_THAT(stopped.history.incomplete, Contains("stress_stiffening"));
    REQUIRE(stopped.history.warnings.size() == 1);
    CHECK_THAT(stopped.history.warnings[0],
               Contains("' leaves the small deformations of its modes at ") &&
                   Contains(" s and at worst displaces interface") &&
                   Contains("divide it into several bodies"));
    CHECK(stopped.history.warnings[0].size() + std::string("Warning: ").size() <= 200);
  }
}

TEST_CASE(
    "a pressed column softens to nothing at Euler's load, and a linear one does not feel it") {
  constexpr int kModes = 4;
  const Beam beam;
  const double x = kClampedFree[0];
  const double omega = 2 * std::numbers::pi * beam.fore_aft_Hz;
  const double L = beam.length_m;
  const double EI = beam.mass_kg * L * L * L * omega * omega / std::pow(x, 4);
  const double euler_N = std::pow(std::numbers::pi / (2 * L), 2) * EI;
  const double unit = EI / (beam.mass_kg * L * L * L);
  REQUIRE(pressed_column_square(0) == Approx(std::pow(x, 4)).epsilon(1e-9));
  for (const double share : {-0.5, 0.3, 0.8}) {
    CAPTURE(share);
    const double exact = unit * pressed_column_square(share * euler_N * L * L / EI);
    // Error of four modes in the shape: 1e-3 of Euler's load.
    CHECK(first_square(column(kModes, true, share * euler_N)) ==
          Approx(exact).margin(1e-3 * std::abs(share) * omega * omega));
    CHECK(first_square(column(kModes, false, share * euler_N)) ==
          Approx(omega * omega).epsilon(1e-8));
  }
  const SystemMode buckling = system_modes(column(kModes, true, 1.01 * euler_N))[0];
  CHECK(buckling.frequency_Hz == 0);
  CHECK(buckling.is_unstable());
}
