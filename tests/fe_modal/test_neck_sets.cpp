// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <string>

#include <catch2/catch.hpp>

#include "fe_modal/modal_analysis.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kInch = 0.0254;
constexpr double kPound = 0.45359237;

/// Ten modes at default divisions, with the head of the Hybrid III on top: 9.921 lb, 2.00 in above
/// and 0.55 in ahead of the joint point, inertia in lbf s^2 in about its centre.
ModalBody neck(const std::string& set) {
  constexpr double kInertiaUnit = 4.4482216152605 * kInch;
  Eigen::Matrix3d inertia;
  inertia << .1518, 0, .0219, 0, .2128, 0, .0219, 0, .1846;
  ModalOptions options;
  options.held_set = "bolts";
  options.held_interface = "base";
  options.interfaces = {{"top", "top", {0, 0, 5.66 * kInch}}};
  options.rigid_parts = {"base_plate", "plate_1", "plate_2", "plate_3", "top_plate"};
  options.sign_interface = "top";
  options.length_m = 5.66 * kInch;
  options.attachments = {
      {"head", "top", 9.921 * kPound, {0.55 * kInch, 0, 7.66 * kInch}, kInertiaUnit * inertia}};
  return analyse_modes(testing::neck_mesh(set), options, {});
}

/// Compares by name with converged frequencies (two independent solvers, other elements and
/// meshes).
void check_frequencies(const ModalBody& body, double tolerance,
                       const std::map<std::string, double>& converged) {
  for (const auto& [name, expected] : converged) {
    CAPTURE(name);
    const double found = body.frequencies_Hz[body.mode_index(name)];
    CHECK(std::abs(found / expected - 1) < tolerance);
  }
}

/// By symmetry fore-aft motion does not mix with lateral motion and twist.
void check_planes(const ModalBody& body) {
  constexpr double kNone = 1e-6;  // per cent
  for (const ModeRecord& mode : body.modes) {
    CAPTURE(mode.name);
    const auto& [fore_aft, lateral, twist, axial] = mode.shares_percent;
    CHECK(fore_aft + lateral + twist + axial == Approx(100));
    CHECK(std::min(fore_aft + axial, lateral + twist) < kNone);
  }
  CHECK(
      body.modes[static_cast<std::size_t>(body.mode_index("lateral bending 1"))].shares_percent[2] >
      0.1);
}

}  // namespace

TEST_CASE("set A meets its converged frequencies") {
  const ModalBody body = neck("A");
  check_frequencies(body, 0.0015,
                    {{"fore-aft bending 1", 36.16},
                     {"lateral bending 1", 36.115},
                     {"torsion 1", 57.27},
                     {"lateral bending 2", 143.92},
                     {"fore-aft bending 2", 141.45},
                     {"torsion 2", 184.31},
                     {"axial 1", 185.5}});
  check_planes(body);
  CHECK(body.invariants.mass / kPound == Approx(3.15).epsilon(0.002));
  CHECK(body.attached.at(0).frequencies_Hz[0] == Approx(6.99).epsilon(0.005));
}

TEST_CASE("set B meets its converged frequencies") {
  const ModalBody body = neck("B");
  check_frequencies(body, 0.0025,
                    {{"fore-aft bending 1", 36.01},
                     {"lateral bending 1", 36.36},
                     {"torsion 1", 57.29},
                     {"lateral bending 2", 141.12},
                     {"fore-aft bending 2", 144.24},
                     {"torsion 2", 184.52},
                     {"axial 1", 200.4}});
  check_planes(body);
  CHECK(body.invariants.mass / kPound == Approx(3.30).epsilon(0.002));
  CHECK(body.attached.at(0).frequencies_Hz[0] == Approx(6.48).epsilon(0.005));
}

TEST_CASE("set C meets its converged frequencies, the weight and the system frequency") {
  const ModalBody body = neck("C");
  check_frequencies(body, 0.0025,
                    {{"fore-aft bending 1", 35.90},
                     {"lateral bending 1", 36.31},
                     {"torsion 1", 57.24},
                     {"lateral bending 2", 141.04},
                     {"fore-aft bending 2", 143.87},
                     {"torsion 2", 184.08},
                     {"axial 1", 186.0}});
  check_planes(body);
  CHECK(body.invariants.mass / kPound == Approx(2.668).epsilon(0.03));
  CHECK(std::abs(body.attached.at(0).frequencies_Hz[0] - 4.98) < 0.05);
}

TEST_CASE("set C' meets its converged frequencies") {
  const ModalBody body = neck("C'");
  check_frequencies(body, 0.0025,
                    {{"fore-aft bending 1", 36.00},
                     {"lateral bending 1", 36.05},
                     {"torsion 1", 57.19},
                     {"lateral bending 2", 143.34},
                     {"fore-aft bending 2", 142.18},
                     {"torsion 2", 184.17},
                     {"axial 1", 182.2}});
  check_planes(body);
  CHECK(body.invariants.mass / kPound == Approx(2.69).epsilon(0.002));
  CHECK(body.attached.at(0).frequencies_Hz[0] == Approx(5.09).epsilon(0.005));
}

}  // namespace flexneck::fe_modal
