// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/analysis/linearisation.h"
#include "multibody/forces/section.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/sections.h"
#include "tests/support/test_models.h"

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;
using namespace flexneck::testing;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

namespace {

/// Stiffness of a straight slender beam from its base to its end along z: end loads over end
/// motions.
Matrix6d beam_stiffness(double length_m, double EA, double EI, double GJ) {
  const double l = length_m;
  Matrix6d K = Matrix6d::Zero();
  K(2, 2) = EA / l;
  K(5, 5) = GJ / l;
  K(0, 0) = K(1, 1) = 12 * EI / (l * l * l);
  K(3, 3) = K(4, 4) = 4 * EI / l;
  K(0, 4) = K(4, 0) = -6 * EI / (l * l);
  K(1, 3) = K(3, 1) = 6 * EI / (l * l);
  return K;
}

MarkerKinematics random_marker(RandomNumbers& random) {
  MarkerKinematics marker;
  marker.p = 0.3 * random.vector();
  marker.R = random.rotation().toRotationMatrix();
  return marker;
}

/// Stored energy of a section between two markers, and the load on j.
std::pair<double, ForceLoad> acted(const Section& section, const MarkerKinematics& i,
                                   const MarkerKinematics& j) {
  ForceLoad load;
  ForceEnergies sums;
  section.act({i, j, {}, {}, 0}, load, sums);
  return {sums.stored_J, load};
}

}  // namespace

TEST_CASE("a section's load is the gradient of its energy, and turns with it") {
  RandomNumbers random(17);
  Section section{"rubber", 0, 1, {0.03, -0.02, 0.2}, random_stiffness(random)};
  const MarkerKinematics i = random_marker(random);
  MarkerKinematics j = random_marker(random);
  const auto [energy, load] = acted(section, i, j);
  CHECK(energy > 0);
  constexpr double kStep = 1e-6;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vector3d unit = Vector3d::Unit(axis);
    const auto energy_at = [&](double moved, double turned) {
      MarkerKinematics at = j;
      at.p += moved * unit;
      at.R = rotation_exp(turned * unit) * at.R;
      return acted(section, i, at).first;
    };
    const double force = (energy_at(-kStep, 0) - energy_at(kStep, 0)) / (2 * kStep);
    const double moment = (energy_at(0, -kStep) - energy_at(0, kStep)) / (2 * kStep);
    CHECK(load.force_N[axis] == Approx(force).epsilon(1e-7).margin(1e-6));
    CHECK(load.moment_Nm[axis] == Approx(moment).epsilon(1e-7).margin(1e-6));
  }
  const Matrix3d turn = random.rotation().toRotationMatrix();
  const auto turned = [&](const MarkerKinematics& marker) {
    MarkerKinematics moved = marker;
    moved.p = turn * marker.p + Vector3d(1, 2, 3);
    moved.R = turn * marker.R;
    return moved;
  };
  const auto [same, moved] = acted(section, turned(i), turned(j));
  CHECK(same == Approx(energy).epsilon(1e-12));
  CHECK((moved.force_N - turn * load.force_N).norm() < 1e-11 * load.force_N.norm());
  CHECK((moved.moment_Nm - turn * load.moment_Nm).norm() < 1e-11 * load.moment_Nm.norm());
}

TEST_CASE("under small motions a section is as stiff as its matrix, seen from marker i") {
  RandomNumbers random(18);
  const Section section{"rubber", 0, 1, {0.03, -0.02, 0.2}, random_stiffness(random)};
  const MarkerKinematics i = random_marker(random);
  constexpr double kStep = 1e-6;
  for (Eigen::Index c = 0; c < 6; ++c) {
    const auto load_at = [&](double step) {
      MarkerKinematics j = i;
      const Vector3d moved = c < 3 ? Vector3d(step * Vector3d::Unit(c)) : Vector3d::Zero();
      const Vector3d turned = c < 3 ? Vector3d::Zero() : Vector3d(step * Vector3d::Unit(c - 3));
      j.p += i.R * (section.rest_m + moved);
      j.R = i.R * rotation_exp(turned);
      const ForceLoad load = acted(section, i, j).second;
      Eigen::Matrix<double, 6, 1> in_i;
      in_i << i.R.transpose() * load.force_N, i.R.transpose() * load.moment_Nm;
      return in_i;
    };
    const auto column =
        Eigen::Matrix<double, 6, 1>((load_at(-kStep) - load_at(kStep)) / (2 * kStep));
    CHECK((column - section.stiffness.col(c)).norm() < 1e-8 * section.stiffness.norm());
  }
}

TEST_CASE(
    "a bending curve makes the moment its own, and the load stays the gradient of the energy") {
  constexpr double kLength_m = 0.2;
  constexpr double kEI = 7;
  constexpr double kSlope = kEI / kLength_m;
  Section section{"beam", 0, 1, {0, 0, kLength_m}, beam_stiffness(kLength_m, 4e4, kEI, 5)};
  section.bending_curve = LoadCurve::table({0, 0.1, 0.5, 1}, {0, 2, 14, 50});
  // The curve's first slope is 20; the stiffness has another one, by which the curve is scaled.
  for (const double turn : {0.05, 0.3, 0.8}) {
    const double radius = kLength_m / turn;
    MarkerKinematics end;
    end.p = {radius * (1 - std::cos(turn)), 0, radius * std::sin(turn)};
    end.R = rotation_exp({0, turn, 0});
    const ForceLoad load = acted(section, {}, end).second;
    CHECK(load.moment_Nm.y() == Approx(-kSlope / 20 * section.bending_curve.value(turn)));
    CHECK(load.force_N.norm() < 1e-9);
  }
  MarkerKinematics j;
  j.p = {0.02, -0.03, 0.19};
  j.R = rotation_exp({0.3, -0.5, 0.2});
  const ForceLoad load = acted(section, {}, j).second;
  constexpr double kStep = 1e-6;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto energy_at = [&](double moved, double turned) {
      MarkerKinematics at = j;
      at.p += moved * Vector3d::Unit(axis);
      at.R = rotation_exp(turned * Vector3d::Unit(axis)) * at.R;
      return acted(section, {}, at).first;
    };
    CHECK(load.force_N[axis] ==
          Approx((energy_at(-kStep, 0) - energy_at(kStep, 0)) / (2 * kStep)).epsilon(1e-6));
    CHECK(load.moment_Nm[axis] ==
          Approx((energy_at(0, -kStep) - energy_at(0, kStep)) / (2 * kStep)).epsilon(1e-6));
  }
}

TEST_CASE("a beam section bent to an arc of its length carries the moment of an elastica alone") {
  constexpr double kLength_m = 0.4;
  constexpr double kEI = 7;
  const double turn = GENERATE(0.05, 1.0, 2.5);
  const Section section{"beam", 0, 1, {0, 0, kLength_m}, beam_stiffness(kLength_m, 4e4, kEI, 5)};
  const double radius = kLength_m / turn;
  MarkerKinematics end;
  end.p = {radius * (1 - std::cos(turn)), 0, radius * std::sin(turn)};
  end.R = rotation_exp(turn * Vector3d::UnitY());
  const auto [energy, load] = acted(section, {}, end);
  CHECK(load.force_N.norm() < 1e-10 * kEI / (radius * radius) + 1e-10);
  CHECK((load.moment_Nm + kEI / radius * Vector3d::UnitY()).norm() < 1e-12 * kEI / radius);
  CHECK(energy == Approx(kEI * turn * turn / (2 * kLength_m)).epsilon(1e-12));
}

TEST_CASE("a chain of sections under a load at its end tends to the published elastica") {
  // K. Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145, P L^2 / (E I) = 10.
  constexpr double kShortening = 0.55500;
  constexpr double kDeflection = 0.81061;
  constexpr double kTurn = 1.43029;
  constexpr double kEI = 2;
  const auto error_of = [&](int sections) {
    ModelBuilder build;
    std::size_t below = build.marker("ground", build.ground());
    for (int k = 1; k <= sections; ++k) {
      const double l = 1.0 / sections;
      const std::string name = "plate " + std::to_string(k);
      const auto marker = build.marker(name, build.body(name, ball(0.1, 1e-4), {{0, 0, k * l}}));
      build.model.forces.add(
          Section{name, below, marker, {0, 0, l}, beam_stiffness(l, 1e7, kEI, 5)});
      below = marker;
    }
    build.force("load", below, Vector3d::UnitX(), constant_table(10 * kEI));
    const History history = simulate_from_equilibrium(build.model, {}, {1e-5, 1e-5});
    const MarkerHistory& tip = history.marker("plate " + std::to_string(sections));
    const Eigen::Vector4d q = tip.rotation.col(0);
    const double turn = 2 * std::atan2(q[2], q[0]);
    return Vector3d(tip.position_m(0, 0) - kDeflection, 1 - tip.position_m(2, 0) - kShortening,
                    turn - kTurn)
        .norm();
  };
  const double coarse = error_of(4);
  const double fine = error_of(8);
  CHECK(coarse < 2e-3);
  CHECK(fine < coarse / 8);
}
