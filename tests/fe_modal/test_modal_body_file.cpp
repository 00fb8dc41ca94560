// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/files.h"
#include "tests/support/point_mass_body.h"

namespace flexneck::fe_modal {
namespace {

using testing::bytes_of;

/// A body in which no two numbers are equal, so that an exchange is detected.
ModalBodyFile sample() {
  ModalBodyFile file;
  file.body = testing::make_point_mass_body(11, 3).body;
  for (std::size_t k = 0; k < file.body.modes.size(); ++k) {
    const double v = static_cast<double>(k) + 1;
    file.body.modes[k] = {
        "bending " + std::to_string(k + 1), "normal", {10 * v, 20 * v, 30 * v, 40 * v}, 1e-9 * v};
  }
  file.body.modes[0].mesh_error = MeshError{0.5, 0.875, 0.25};
  file.body.modes[2].mesh_error = MeshError{1.5, 0.75, 1};
  file.body.orthogonality = 3e-12;
  file.body.attached = {{"head", "tip", Eigen::Vector3d(1.5, 2.5, 3.5)}};
  file.provenance.program = "flexneck test";
  file.provenance.libraries = {{"PETSc", "3.18.5"}};
  return file;
}

void check_same(const InertiaInvariants& found, const InertiaInvariants& expected) {
  CHECK(found.mass == expected.mass);
  CHECK(found.S1 == expected.S1);
  CHECK(found.S2 == expected.S2);
  CHECK(found.J0 == expected.J0);
  CHECK(found.G0 == expected.G0);
  CHECK(found.G == expected.G);
  CHECK(found.N0 == expected.N0);
  CHECK(found.N == expected.N);
  CHECK(found.Maa == expected.Maa);
}

/// Adds a static response with the compliance of the modes and a little more.
void add_response(const ModalBody& body, Interface& interface) {
  StaticResponse response{0.01 * Eigen::Matrix<double, 6, 6>::Identity(),
                          0.01 * Eigen::Matrix<double, 6, 6>::Identity()};
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    Eigen::Matrix<double, 6, 1> motion;
    motion << interface.translation.col(k), interface.rotation.col(k);
    const double omega = 2 * std::numbers::pi * body.frequencies_Hz[k];
    response.compliance += motion * motion.transpose() / (omega * omega);
    response.mass += motion * motion.transpose() / std::pow(omega, 4);
  }
  interface.response = response;
}

/// Point masses without supports: six rigid motions, mass-orthonormal.
ModalBodyFile free_sample() {
  constexpr Eigen::Index kMotions = 6;
  ModalBodyFile file;
  const testing::PointMassBody points = testing::make_point_mass_body(12, 1);
  ModalBody& body = file.body;
  body.nodes_m = points.body.nodes_m;
  const auto motions_at = [](const Eigen::Vector3d& p) {
    Eigen::Matrix<double, 3, kMotions> motions;
    motions << Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitX().cross(p),
        Eigen::Vector3d::UnitY().cross(p), Eigen::Vector3d::UnitZ().cross(p);
    return motions;
  };
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(kMotions, kMotions);
  for (Eigen::Index n = 0; n < points.point_count(); ++n) {
    const auto motions = motions_at(body.nodes_m.col(n));
    mass += points.masses_kg[n] * motions.transpose() * motions;
  }
  // With M = U^T U the columns of U^-1 are mass-orthonormal.
  const Eigen::MatrixXd orthonormal =
      mass.llt().matrixU().solve(Eigen::MatrixXd::Identity(kMotions, kMotions));
  const Eigen::Vector3d tip(0.1, -0.2, 0.3);
  body.interfaces = {
      {"root", Eigen::Vector3d::Zero(), orthonormal.topRows<3>(), orthonormal.bottomRows<3>()},
      {"tip", tip, motions_at(tip) * orthonormal, orthonormal.bottomRows<3>()}};
  for (Eigen::Index k = 0; k < kMotions; ++k) {
    Eigen::Matrix3Xd shape(3, points.point_count());
    for (Eigen::Index n = 0; n < points.point_count(); ++n) {
      shape.col(n) = motions_at(body.nodes_m.col(n)) * orthonormal.col(k);
    }
    body.shapes.push_back(shape);
    body.modes.push_back({"rigid " + std::to_string(k + 1), "rigid", {}, 0});
  }
  body.frequencies_Hz = Eigen::VectorXd::Zero(kMotions);
  body.boundary = "free";
  body.completeness = "not checked";
  body.invariants = testing::invariants_of_points(points.masses_kg, body.nodes_m, body.shapes);
  file.provenance.program = "flexneck test";
  return file;
}

}  // namespace

TEST_CASE("a modal body comes back from its file bit by bit") {
  const TemporaryFolder folder;
  const ModalBodyFile written = sample();
  write_modal_body(folder / "modes.h5", written);
  const ModalBodyFile read = read_modal_body(folder / "modes.h5");
  const ModalBody& found = read.body;
  const ModalBody& expected = written.body;
  CHECK(found.frequencies_Hz == expected.frequencies_Hz);
  CHECK(found.nodes_m == expected.nodes_m);
  CHECK(found.shapes == expected.shapes);
  CHECK(found.boundary == expected.boundary);
  CHECK(found.completeness == expected.completeness);
  CHECK(found.orthogonality == expected.orthogonality);
  REQUIRE(found.modes.size() == expected.modes.size());
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    CHECK(found.modes[k].name == expected.modes[k].name);
    CHECK(found.modes[k].kind == expected.modes[k].kind);
    CHECK(found.modes[k].shares_percent == expected.modes[k].shares_percent);
    CHECK(found.modes[k].residual == expected.modes[k].residual);
    REQUIRE(found.modes[k].mesh_error.has_value() == expected.modes[k].mesh_error.has_value());
    if (!found.modes[k].mesh_error) continue;
    CHECK(found.modes[k].mesh_error->refined_Hz == expected.modes[k].mesh_error->refined_Hz);
    CHECK(found.modes[k].mesh_error->mac == expected.modes[k].mesh_error->mac);
    CHECK(found.modes[k].mesh_error->error == expected.modes[k].mesh_error->error);
  }
  REQUIRE(found.interfaces.size() == expected.interfaces.size());
  for (const Interface& interface : expected.interfaces) {
    const Interface& twin = found.interface(interface.name);
    CHECK(twin.position_m == interface.position_m);
    CHECK(twin.translation == interface.translation);
    CHECK(twin.rotation == interface.rotation);
  }
  check_same(found.invariants, expected.invariants);
  REQUIRE(found.attached.size() == 1);
  CHECK(found.attached[0].body == "head");
  CHECK(found.attached[0].interface == "tip");
  CHECK(found.attached[0].frequencies_Hz == expected.attached[0].frequencies_Hz);
  CHECK(read.provenance.program == written.provenance.program);
  CHECK(read.provenance.libraries == written.provenance.libraries);
}

TEST_CASE("a body without attached ones is written and read, and twice gives the same bytes") {
  const TemporaryFolder folder;
  ModalBodyFile file = sample();
  file.body.attached.clear();
  write_modal_body(folder / "one.h5", file);
  write_modal_body(folder / "two.h5", file);
  CHECK(read_modal_body(folder / "one.h5").body.attached.empty());
  CHECK(bytes_of(folder / "one.h5") == bytes_of(folder / "two.h5"));
}

TEST_CASE("modes that are not mass-normalised are refused") {
  const TemporaryFolder folder;
  ModalBodyFile file = sample();
  file.body.invariants.Maa(0, 1) += 2e-6;
  write_modal_body(folder / "modes.h5", file);
  CHECK_THROWS_AS(read_modal_body(folder / "modes.h5"), InputError);
  CHECK_THROWS_WITH(read_modal_body(folder / "modes.h5"),
                    Catch::Contains("modes.h5") && Catch::Contains("not mass-normalised"));
}

TEST_CASE("what breaks an identity of every modal body is refused by its dataset and entry") {
  struct Case {
    const char* dataset;
    std::function<void(ModalBody&)> damage;
  };
  const std::vector<Case> cases = {
      {"/mode_names", [](ModalBody& b) { b.modes[1].name = b.modes[0].name; }},
      {"/basis/kind: [1]", [](ModalBody& b) { b.modes[1].kind = "Normal"; }},
      {"/frequencies: [0]", [](ModalBody& b) { b.frequencies_Hz[0] = 0; }},
      {"/frequencies: [1]", [](ModalBody& b) { b.frequencies_Hz[1] = -3; }},
      {"/frequencies: [2]", [](ModalBody& b) { b.frequencies_Hz[2] = 1e200; }},
      {"/frequencies: [1]",
       [](ModalBody& b) { std::swap(b.frequencies_Hz[0], b.frequencies_Hz[1]); }},
      {"/invariants/mass", [](ModalBody& b) { b.invariants.mass *= -1; }},
      {"/invariants/Maa", [](ModalBody& b) { b.invariants.Maa(2, 2) += 2e-6; }},
      {"/invariants/J0: expected that [1, 0]",
       [](ModalBody& b) { b.invariants.J0(0, 1) += 1e-11 * b.invariants.J0(0, 0); }},
      {"/invariants/J0", [](ModalBody& b) { b.invariants.J0 *= -1; }},
      // The moment of inertia about the normal of a plate is at most the sum of the other two.
      {"/invariants/J0", [](ModalBody& b) { b.invariants.J0(2, 2) += b.invariants.J0.trace(); }},
      {"/invariants/J0", [](ModalBody& b) { b.invariants.S1 *= 4; }},
      {"/invariants/G: expected that half the trace of [0, 0]",
       [](ModalBody& b) {
         for (Eigen::Matrix3d& g : b.invariants.G) g *= 2;
       }},
      {"/invariants/G: expected that [0, 1] is the transpose of [1, 0]",
       [](ModalBody& b) { b.invariants.G[1](0, 2) += 1e-11; }},
      {"/invariants/N: expected that [0, 2] is minus [2, 0]",
       [](ModalBody& b) { b.invariants.N[2].y() += 1e-11; }},
      {"/invariants/N: expected that [0, 1] matches the antisymmetric part",
       [](ModalBody& b) {
         b.invariants.N[1] *= -1;
         b.invariants.N[3] *= -1;
       }},
      {"/invariants/N: expected that [1, 1]", [](ModalBody& b) { b.invariants.N[4].x() = 1; }},
      {"/invariants/N0: expected that column 1",
       [](ModalBody& b) { b.invariants.N0.col(1) *= -1; }},
      {"/invariants/N0: expected that column 2",
       [](ModalBody& b) { b.invariants.G0[2].transposeInPlace(); }},
      {"/invariants/S2", [](ModalBody& b) { b.invariants.S2 *= 10; }},
      {"/invariants/G0",
       [](ModalBody& b) {
         for (Eigen::Matrix3d& g : b.invariants.G0) g *= 10;
         b.invariants.N0 *= 10;
       }},
      {"/interfaces/tip/compliance: expected that [4, 0]",
       [](ModalBody& b) { b.interfaces[1].response->compliance(0, 4) *= 1.1; }},
      {"/interfaces/tip/compliance: expected that [0, 0] is positive",
       [](ModalBody& b) { b.interfaces[1].response->compliance *= -1; }},
      {"/interfaces/tip/response_mass: expected that the mass is positive",
       [](ModalBody& b) {
         b.interfaces[1].response->mass(1, 2) += 1;
         b.interfaces[1].response->mass(2, 1) += 1;
       }},
      {"/interfaces/tip/compliance: expected that the static compliance minus that of the modes",
       [](ModalBody& b) { b.interfaces[1].translation *= 2; }},
      {"/interfaces/tip/response_mass: expected that [2, 1]",
       [](ModalBody& b) { b.interfaces[1].response->mass(1, 2) += 0.01; }},
      {"/attached/head", [](ModalBody& b) { b.attached[0].interface = "tpi"; }},
      {"/attached/head/frequencies", [](ModalBody& b) { b.attached[0].frequencies_Hz[2] = 1; }},
      {"/geometric_stiffness/acceleration: matrix 1",
       [](ModalBody& b) { b.geometric_stiffness->acceleration[1](0, 2) += 1; }},
      {"/geometric_stiffness/interfaces/side/moment: matrix 2",
       [](ModalBody& b) { b.geometric_stiffness->interfaces[1].moment[2](2, 1) *= 2; }},
  };
  const TemporaryFolder folder;
  ModalBodyFile whole = sample();
  add_response(whole.body, whole.body.interfaces[1]);
  write_modal_body(folder / "modes.h5", whole);
  CHECK_NOTHROW(read_modal_body(folder / "modes.h5"));
  for (const Case& each : cases) {
    INFO(each.dataset);
    ModalBodyFile file = whole;
    each.damage(file.body);
    write_modal_body(folder / "modes.h5", file);
    CHECK_THROWS_AS(read_modal_body(folder / "modes.h5"), InputError);
    CHECK_THROWS_WITH(read_modal_body(folder / "modes.h5"),
                      Catch::Contains("modes.h5: ") && Catch::Contains(each.dataset));
  }
}

TEST_CASE("modes of kind rigid have the frequency zero and move as a rigid body") {
  const TemporaryFolder folder;
  const ModalBodyFile whole = free_sample();
  write_modal_body(folder / "modes.h5", whole);
  CHECK_NOTHROW(read_modal_body(folder / "modes.h5"));
  const std::vector<std::pair<const char*, std::function<void(ModalBody&)>>> cases = {
      {"/frequencies: [5]", [](ModalBody& b) { b.frequencies_Hz[5] = 1e-3; }},
      {"/shapes: expected that rigid mode 3", [](ModalBody& b) { b.shapes[3](1, 4) += 1e-4; }},
      {"/interfaces/tip/translation: expected that rigid mode 4",
       [](ModalBody& b) { b.interfaces[1].translation(2, 4) += 1e-4; }},
      {"/interfaces/tip/rotation: expected that rigid mode 5",
       [](ModalBody& b) { b.interfaces[1].rotation(0, 5) += 1e-2; }},
      {"/invariants/S2: expected that rigid mode 0",
       [](ModalBody& b) { b.invariants.mass *= 1.01; }},
      // No other identity of a fixed body shows that its moments of inertia are too large.
      {"/invariants/N0: expected that rigid mode", [](ModalBody& b) { b.invariants.J0 *= 1.01; }},
  };
  for (const auto& [dataset, damage] : cases) {
    INFO(dataset);
    ModalBodyFile file = whole;
    damage(file.body);
    write_modal_body(folder / "modes.h5", file);
    CHECK_THROWS_WITH(read_modal_body(folder / "modes.h5"), Catch::Contains(dataset));
  }
}

TEST_CASE("missing, truncated and foreign files are refused with one line") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_modal_body(folder / "none.h5"), InputError);

  write_modal_body(folder / "modes.h5", sample());
  const std::string whole = bytes_of(folder / "modes.h5");
  for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(folder / "cut.h5", std::ios::binary) << whole.substr(0, size);
    CHECK_THROWS_AS(read_modal_body(folder / "cut.h5"), InputError);
  }

  { Hdf5Writer(folder / "mesh.h5", FileFormat{"flexneck mesh", 1, "flexneck mesh"}).commit(); }
  CHECK_THROWS_WITH(read_modal_body(folder / "mesh.h5"), Catch::Contains("flexneck mesh"));
}

TEST_CASE("datasets whose shapes contradict each other are refused by name") {
  const TemporaryFolder folder;
  ModalBodyFile file = sample();
  file.body.shapes.pop_back();
  write_modal_body(folder / "modes.h5", file);
  CHECK_THROWS_AS(read_modal_body(folder / "modes.h5"), InputError);
  CHECK_THROWS_WITH(read_modal_body(folder / "modes.h5"), Catch::Contains("/shapes"));

  file = sample();
  file.body.modes.pop_back();
  write_modal_body(folder / "names.h5", file);
  CHECK_THROWS_WITH(read_modal_body(folder / "names.h5"), Catch::Contains("/mode_names"));
}

}  // namespace flexneck::fe_modal
