// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed base - neck - head, compared with the form without multipliers (equations.md section
// 6).
#include <cmath>

#include <catch2/catch.hpp>

#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/minimal_neck.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Modal coordinates at each whole interval by the classical Runge-Kutta method, starting at rest.
std::vector<VectorXd> integrate(const MinimalModel& model, double interval_s, int intervals,
                                int steps) {
  const Eigen::Index m = model.neck.mode_count();
  VectorXd a = VectorXd::Zero(m);
  VectorXd v = VectorXd::Zero(m);
  std::vector<VectorXd> found = {a};
  const double h = interval_s / steps;
  for (int k = 0; k < intervals; ++k) {
    for (int step = 0; step < steps; ++step) {
      const double t = k * interval_s + step * h;
      const VectorXd f1 = model.accelerations(t, a, v);
      const VectorXd v2 = v + h / 2 * f1;
      const VectorXd f2 = model.accelerations(t + h / 2, a + h / 2 * v, v2);
      const VectorXd v3 = v + h / 2 * f2;
      const VectorXd f3 = model.accelerations(t + h / 2, a + h / 2 * v2, v3);
      const VectorXd v4 = v + h * f3;
      const VectorXd f4 = model.accelerations(t + h, a + h * v3, v4);
      a += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (f1 + 2 * f2 + 2 * f3 + f4);
    }
    found.push_back(a);
  }
  return found;
}

/// A stop from 7 m/s that bends the neck by about a right angle; its kinks lie on the grid below.
TimeTable strong_pulse() {
  return {{0.0, 0.01, 0.03, 0.04}, {0.0, -260.0, -200.0, 0.0}, TimeTable::Outside::zero};
}

}  // namespace

TEST_CASE("Prescribed base, neck and head move as the modal coordinates alone do") {
  const Vector3d direction_N = Vector3d(0.9, 0.5, 0.1).normalized();
  Beam beam;
  beam.twist_modes = 1;
  const Pose pose = hanging_pose();
  const RigidBody head = make_head();
  const PrescribedBody base{pose.rotation * direction_N, 7, strong_pulse()};
  ModelBuilder build = head_on_neck(base, pose, beam, 0.9, head);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const History history =
      simulate(build.model, tight_solver(), {.end_time_s = 0.1, .interval_s = 0.01});

  const MinimalModel minimal{make_beam_body(beam),
                             0.9,
                             head,
                             pose.rotation.conjugate() * build.model.gravity_m_s2,
                             direction_N,
                             strong_pulse()};
  const std::vector<VectorXd> coarse = integrate(minimal, 0.01, 10, 400);
  const std::vector<VectorXd> fine = integrate(minimal, 0.01, 10, 800);
  const double largest = history.modal[0].coordinates.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    // The reference is converged, and the run agrees with it.
    CHECK((coarse[at] - fine[at]).norm() < 1e-8 * largest);
    CHECK((history.modal[0].coordinates.col(k) - fine[at]).norm() < 1e-8 * largest);
  }
  // It is a large motion in space, so that every term matters.
  const Eigen::AngleAxisd turned(pose.rotation.conjugate() *
                                 rotation_at(history.marker("head cg").rotation, 6));
  CHECK(turned.angle() > 0.8);
}

TEST_CASE("A pulse at 45 degrees on equal bending modes and a centred head makes no yaw") {
  Beam beam;
  beam.lateral_Hz = beam.fore_aft_Hz;
  RigidBody head;
  head.mass_kg = 4.5;
  head.center_m = {0, 0, 0.0508};
  head.inertia_kg_m2 = Vector3d(0.02, 0.02, 0.015).asDiagonal();
  const Pose pose = hanging_pose();
  const Vector3d diagonal_N = Vector3d(1, 1, 0).normalized();
  ModelBuilder build =
      head_on_neck({pose.rotation * diagonal_N, 7, strong_pulse()}, pose, beam, 0.9, head);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const History history =
      simulate(build.model, tight_solver(), {.end_time_s = 0.25, .interval_s = 0.005});
  double largest_turn = 0;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const Eigen::AngleAxisd turned(pose.rotation.conjugate() *
                                   rotation_at(history.marker("head cg").rotation, k));
    largest_turn = std::max(largest_turn, turned.angle());
    CHECK(std::abs(turned.angle() * turned.axis().z()) < 1e-8);
    const Vector3d way = pose.rotation.conjugate() * (history.marker("head cg").position_m.col(k) -
                                                      history.marker("base").position_m.col(k));
    CHECK(std::abs(way.x() - way.y()) < 1e-8);
  }
  CHECK(largest_turn > 0.8);
}
