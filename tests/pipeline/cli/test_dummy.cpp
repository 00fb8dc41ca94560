// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped dummy of 17 segments: weight, equilibrium, symmetry, and one motion by two
// formulations.
#include <fstream>

#include <catch2/catch.hpp>

#include "pipeline/language/model/model_file.h"
#include "tests/support/model_reading.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::History;
using testing::run;

namespace {

constexpr double kPound_kg = 0.45359237;
constexpr double kGravity_m_s2 = 9.80665;
const std::string kFolder = std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/models/";

ModelFile dummy(const std::vector<std::string>& settings = {}) {
  return read_model_file(kFolder + "dummy.toml", settings);
}

/// The dummy on a seat that decelerates by at most 100 m/s^2, within 80 ms.
ModelFile dummy_on_sled(const std::string& formulation) {
  return dummy({"body.seat.kind=prescribed",
                "body.seat.acceleration=-100 * sin(pi * t / 0.08) * (t < 0.08)",
                "solver.formulation=" + formulation, "solver.integrator=dormand_prince",
                "solver.relative_tolerance=1e-11", "solver.absolute_tolerance=1e-12",
                "solver.end_time=0.12 s"});
}

double mass_kg(const ModelFile& file) {
  double sum = 0;
  for (const multibody::Body& body : file.model.bodies)
    if (const auto* const rigid = std::get_if<multibody::RigidBody>(&body.kind))
      sum += rigid->mass_kg;
  return sum;
}

/// Largest difference of two histories over time.
double largest_difference(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a - b).colwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("the dummy has 17 segments with the published weight, in at most 150 lines") {
  const ModelFile file = dummy();
  CHECK(file.model.bodies.size() == 1 + 17);  // and the seat
  CHECK(mass_kg(file) / kPound_kg == Approx(167.94).margin(0.005));
  std::size_t lines = 0;
  for (const char* const name : {"dummy.toml", "dummy_leg.toml", "dummy_arm.toml"}) {
    std::ifstream text(kFolder + name);
    for (std::string line; std::getline(text, line);) ++lines;
  }
  CHECK(lines <= 150);
}

TEST_CASE("the dummy stands in equilibrium on its own joints, and its seat carries its weight") {
  const auto* const formulation = GENERATE("descriptor", "recursive");
  const ModelFile file = dummy({std::string("solver.formulation=") + formulation});
  const History history = run(file);
  const double weight_N = mass_kg(file) * kGravity_m_s2;
  // Forces are in the axes of the segments, z down.
  const Eigen::Matrix3Xd& force = history.joint("seat").force_N;
  CHECK((force.colwise() + Eigen::Vector3d(0, 0, weight_N)).colwise().norm().maxCoeff() <
        1e-6 * weight_N);
  CHECK(history.constraints.position_m.maxCoeff() < 1e-12);
  CHECK(history.redundant_constraints.empty());
  // It keeps its initial posture: nothing sags by more than 20 deg, or moves.
  CHECK(history.energy.kinetic_J.maxCoeff() < 1e-12);
  for (const multibody::MarkerHistory& marker : history.markers) {
    CAPTURE(marker.name);
    const Eigen::Vector3d start = marker.position_m.col(0);
    CHECK((marker.position_m.colwise() - start).colwise().norm().maxCoeff() < 1e-9);
  }
  const Eigen::Vector3d head = history.marker("head.cg").position_m.col(0);
  const Eigen::Vector3d foot = history.marker("left_leg:foot.ankle").position_m.col(0);
  const Eigen::Vector3d pelvis = history.marker("lower_torso.cg").position_m.col(0);
  CHECK(head.z() - pelvis.z() == Approx(26.2 * 0.0254).epsilon(0.02));  // upright: 26.28 in
  CHECK(foot.z() < pelvis.z() - 0.25);
  CHECK(foot.x() > pelvis.x() + 0.4);
}

TEST_CASE("the dummy's joints carry what hangs on them") {
  const ModelFile file = dummy();
  const History history = run(file);
  const auto hanging_lb = [&](const std::string& joint) {
    return history.joint(joint).force_N.col(0).norm() / (kPound_kg * kGravity_m_s2);
  };
  CHECK(hanging_lb("condyles") == Approx(9.921).epsilon(1e-7));
  CHECK(hanging_lb("neck") == Approx(9.921 + 2.668).epsilon(1e-7));
  CHECK(hanging_lb("left_leg:hip") == Approx(13.713 + 7.237 + 2.756).epsilon(1e-7));
  CHECK(hanging_lb("right_leg:ankle") == Approx(2.756).epsilon(1e-7));
  CHECK(hanging_lb("right_arm:shoulder") == Approx(4.597 + 3.8 + 1.29).epsilon(1e-7));
  CHECK(hanging_lb("left_arm:wrist") == Approx(1.29).epsilon(1e-7));
}

TEST_CASE("the dummy moves alike in both formulations, and its left side as its right") {
  const History descriptor = run(dummy_on_sled("descriptor"));
  const History recursive = run(dummy_on_sled("recursive"));
  REQUIRE(descriptor.markers.size() == recursive.markers.size());
  for (const multibody::MarkerHistory& marker : descriptor.markers) {
    CAPTURE(marker.name);
    const multibody::MarkerHistory& other = recursive.marker(marker.name);
    CHECK(largest_difference(marker.position_m, other.position_m) < 1e-11);
    CHECK(largest_difference(marker.velocity_m_s, other.velocity_m_s) < 1e-9);
  }
  // The head moves forward relative to the seat.
  const Eigen::Matrix3Xd way =
      descriptor.marker("head.cg").position_m - descriptor.marker("lower_torso.cg").position_m;
  CHECK(way.row(0).maxCoeff() > way(0, 0) + 0.2);
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  for (const std::string name : {"leg:foot.ankle", "leg:lower_leg.ankle", "arm:hand.wrist"}) {
    CAPTURE(name);
    const Eigen::Matrix3Xd left = descriptor.marker("left_" + name).position_m;
    CHECK(left.row(1).minCoeff() > 0.05);  // y is left in the world
    CHECK(largest_difference(mirror * left, descriptor.marker("right_" + name).position_m) < 1e-9);
  }
}

TEST_CASE("the dummy's posture, masses and sources can be told and changed from outside") {
  const ModelFile file =
      dummy({"assembly.left_leg.variables.hip=80 deg", "body.left_leg:foot.mass=3 lb"});
  CHECK(mass_kg(file) / kPound_kg == Approx(167.941 + 3 - 2.756).epsilon(1e-9));
  const auto parameter = [&](const std::string& key) {
    for (const Parameter& each : file.parameters)
      if (each.key == key) return each.value + ", " + std::string(name_of(each.origin));
    return std::string("none");
  };
  CHECK(parameter("assembly.left_leg.variables.hip") == "80 deg, synthetic");
  CHECK(parameter("assembly.right_leg.variables.hip") == "90 deg, synthetic");
  CHECK(parameter("body.right_leg:upper_leg.mass") == "13.713 lb, published");
  CHECK(parameter("marker.left_leg:hip.position") == "-0.11 in, -3.15 in, 1.24 in, published");
  CHECK(parameter("bushing.waist.rotation_stiffness") ==
        "680 in*lbf/deg, 380 in*lbf/deg, 34.38 in*lbf/deg, inferred");
  REQUIRE(file.files.size() == 3);  // each once
}
