// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "fe_modal/exchange/mbdyn_fem.h"
#include "fe_modal/exchange/sid_fem.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/files.h"
#include "tests/support/point_mass_body.h"

using Catch::Matchers::Contains;

namespace flexneck::fe_modal {
namespace {

/// Relative rounding of the numbers in both formats; a text of seventeen digits loses nothing.
constexpr double kRounding = 1e-14;

ModalBody sample() {
  ModalBody body = testing::make_point_mass_body(11, 3).body;
  body.modes[0] = {"bending, fore-aft 1", "normal"};
  body.modes[1] = {"bending 2", "normal"};
  body.modes[2] = {"static shape", "residual"};
  return body;
}

template <class Matrix>
double difference(const std::vector<Matrix>& a, const std::vector<Matrix>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, (a[k] - b[k]).cwiseAbs().maxCoeff());
  return a.size() == b.size() ? largest : 1;
}

void check_same(const InertiaInvariants& found, const InertiaInvariants& truth) {
  CHECK(found.mass == Approx(truth.mass).epsilon(kRounding));
  CHECK((found.S1 - truth.S1).norm() < kRounding);
  CHECK((found.S2 - truth.S2).norm() < kRounding);
  CHECK((found.J0 - truth.J0).norm() < kRounding);
  CHECK((found.N0 - truth.N0).norm() < kRounding);
  CHECK(difference(found.G0, truth.G0) < kRounding);
  CHECK(difference(found.G, truth.G) < kRounding);
  CHECK(difference(found.N, truth.N) < kRounding);
}

void check_same(const ModalBody& found, const ModalBody& truth) {
  CHECK((found.frequencies_Hz - truth.frequencies_Hz).cwiseAbs().maxCoeff() <
        kRounding * truth.frequencies_Hz.maxCoeff());
  for (std::size_t k = 0; k < truth.modes.size(); ++k) {
    CHECK(found.modes[k].name == truth.modes[k].name);
    CHECK(found.modes[k].kind == truth.modes[k].kind);
  }
  REQUIRE(found.interfaces.size() == truth.interfaces.size());
  for (std::size_t k = 0; k < truth.interfaces.size(); ++k) {
    CHECK(found.interfaces[k].name == truth.interfaces[k].name);
    CHECK(found.interfaces[k].position_m == truth.interfaces[k].position_m);
    CHECK(found.interfaces[k].translation == truth.interfaces[k].translation);
    CHECK(found.interfaces[k].rotation == truth.interfaces[k].rotation);
  }
  check_same(found.invariants, truth.invariants);
}

std::string replaced(std::string text, const std::string& was, const std::string& is) {
  const std::size_t place = text.find(was);
  REQUIRE(place != std::string::npos);
  return text.replace(place, was.size(), is);
}

/// MBDyn file of a bar of three lumps along x that bends in y: one mode, mass-normalised, at 1
/// rad/s. Nodes 1 to 3 are at 0, 1 and 2 m; node 1 is fixed.
std::string lumped_bar(const std::string& modal_mass) {
  return R"(** RECORD GROUP 1, HEADER
** REVISION, NODE, NORMAL, ATTACHMENT, CONSTRAINT, REJECTED MODES
 REV0 3 1 0 0 0
** RECORD GROUP 2, FINITE ELEMENT NODE LIST
 10 20 30
** RECORD GROUP 5, NODAL X COORDINATES
 0. 1. 2.
** RECORD GROUP 6, NODAL Y COORDINATES
 0. 0. 0.
** RECORD GROUP 7, NODAL Z COORDINATES
 0. 0. 0.
** RECORD GROUP 8, MODE SHAPES
** NORMAL MODE SHAPE # 1
 0. 0. 0. 0. 0. 0.
 0. 0.5 0. 0. 0. 0.7
 0. 1.5 0. 0. 0. 1.1
** RECORD GROUP 9, MODAL MASS MATRIX
 )" + modal_mass +
         R"(
** RECORD GROUP 10, MODAL STIFFNESS MATRIX
 2.
** RECORD GROUP 11, DIAGONAL OF LUMPED MASS MATRIX
 1D0 1D0 1D0 0. 0. 0.
 +1. 1. 1. 0. 0. 0.
 1. 1. 1. 0. 0. 0.
** RECORD GROUP 13, MODAL DAMPING MATRIX
 0.1
** END OF FILE
)";
}

}  // namespace

TEST_CASE("a body comes back from MBDyn's and Wallrapp's formats with all its invariants") {
  const TemporaryFolder folder;
  const ModalBody body = sample();
  write_mbdyn_fem(folder / "body.fem", body);
  write_sid_fem(folder / "body.SID_FEM", body);
  for (const ImportedModes& found :
       {read_mbdyn_fem(folder / "body.fem"), read_sid_fem(folder / "body.SID_FEM")}) {
    CHECK(found.notes.empty());
    check_same(found.body, body);
  }
}

TEST_CASE("modes of any scale that are coupled come back as eigenvectors") {
  const ModalBody truth = sample();
  Eigen::Matrix3d T;  // combinations of the modes, as another program may choose them
  T << 2, 0.3, -0.1, 0.5, -1, 0.2, 0.1, 0.4, 0.05;
  ReducedBody reduced;
  const InertiaInvariants& inertia = truth.invariants;
  const Eigen::Vector3d omega = 2 * std::numbers::pi * truth.frequencies_Hz;
  reduced.stiffness = T.transpose() * omega.cwiseAbs2().asDiagonal() * T;
  reduced.damping = Eigen::Matrix3d::Zero();
  InertiaInvariants& mixed = reduced.invariants;
  mixed = inertia;
  mixed.S2 = inertia.S2 * T;
  mixed.N0 = inertia.N0 * T;
  mixed.Maa = T.transpose() * T;
  for (Eigen::Index j = 0; j < 3; ++j) {
    mixed.G0[static_cast<std::size_t>(j)].setZero();
    for (Eigen::Index k = 0; k < 3; ++k)
      mixed.G0[static_cast<std::size_t>(j)] += T(k, j) * inertia.G0[static_cast<std::size_t>(k)];
    for (Eigen::Index l = 0; l < 3; ++l) {
      const auto pair = static_cast<std::size_t>(3 * j + l);
      mixed.G[pair].setZero();
      mixed.N[pair].setZero();
      for (Eigen::Index k = 0; k < 3; ++k)
        for (Eigen::Index i = 0; i < 3; ++i) {
          const auto from = static_cast<std::size_t>(3 * k + i);
          mixed.G[pair] += T(k, j) * T(i, l) * inertia.G[from];
          mixed.N[pair] += T(k, j) * T(i, l) * inertia.N[from];
        }
    }
  }
  for (const Interface& each : truth.interfaces)
    reduced.nodes.push_back({each.name, each.position_m, each.translation * T, each.rotation * T});
  const ImportedModes found = import_modes(reduced);
  CHECK(found.notes.size() == 1);
  CHECK(found.body.modes[0].name == "mode 1");
  CHECK((found.body.frequencies_Hz - truth.frequencies_Hz).cwiseAbs().maxCoeff() <
        1e-12 * truth.frequencies_Hz[2]);
  // The eigenvectors agree but for their signs.
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto mode = static_cast<std::size_t>(k);
    const double sign = found.body.invariants.S2.col(k).dot(inertia.S2.col(k)) > 0 ? 1 : -1;
    CHECK((found.body.invariants.S2.col(k) - sign * inertia.S2.col(k)).norm() < 1e-11);
    CHECK((found.body.invariants.G0[mode] - sign * inertia.G0[mode]).norm() < 1e-11);
    CHECK((found.body.invariants.G[4 * mode] - inertia.G[4 * mode]).norm() < 1e-11);
    CHECK((found.body.interfaces[1].rotation.col(k) - sign * truth.interfaces[1].rotation.col(k))
              .norm() < 1e-10);
  }
}

TEST_CASE("lumped masses of an MBDyn file are summed, and contradictions refused") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "bar.fem";
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_mbdyn_fem(path);
  };
  const ImportedModes found = read(lumped_bar("2.5"));  // mass 0.5^2 + 1.5^2
  const ModalBody& body = found.body;
  // The frequency is sqrt(2 / 2.5) rad/s, shapes are divided by sqrt(2.5).
  CHECK(body.frequencies_Hz[0] == Approx(std::sqrt(0.8) / (2 * std::numbers::pi)).epsilon(1e-14));
  CHECK(body.interfaces[2].name == "node 30");
  CHECK(std::abs(body.interfaces[2].rotation(2, 0)) == Approx(1.1 / std::sqrt(2.5)));
  CHECK(body.invariants.mass == 3);
  CHECK(body.invariants.J0(1, 1) == 5);                                       // 1 + 4
  CHECK(std::abs(body.invariants.S2(1, 0)) == Approx(2 / std::sqrt(2.5)));    // 0.5 + 1.5
  CHECK(std::abs(body.invariants.N0(2, 0)) == Approx(3.5 / std::sqrt(2.5)));  // 0.5 + 2 * 1.5
  REQUIRE(found.notes.size() == 2);
  CHECK_THAT(found.notes[1], Contains("damping_ratio = [0.0223606"));  // 0.04 / (2 sqrt(0.8))
  CHECK_THROWS_WITH(read(lumped_bar("2.6")),
                    Contains("bar.fem: the centrifugal terms and the generalised mass of mode 1") &&
                        Contains("differ by 0.1"));
  CHECK_THROWS_WITH(read(replaced(lumped_bar("2.5"), " 1D0 1D0 1D0 0.", " 1D0 1D0 1D0 1.")),
                    Contains("bar.fem:22: lumped masses with rotary inertia are not supported"));
  CHECK_THROWS_WITH(
      read(replaced(lumped_bar("2.5"), " 2.\n** RECORD GROUP 11", " 2. 3.\n** RECORD GROUP 11")),
      Contains("expected 1 numbers in RECORD GROUP 10, found 2"));
  CHECK_THROWS_WITH(read(replaced(lumped_bar("2.5"), "1\n** END OF FILE\n", "")),
                    Contains("bar.fem:26: expected '** END OF FILE', found none"));
  CHECK_THROWS_WITH(read(replaced(lumped_bar("2.5"), "GROUP 10,", "GROUP 20,")),
                    Contains("bar.fem:19: expected a RECORD GROUP from 1 to 19"));
}

TEST_CASE("an SID_FEM file whose blocks contradict each other is refused") {
  const TemporaryFolder folder;
  write_sid_fem(folder / "sound.SID_FEM", sample());
  const std::string sound = testing::bytes_of(folder / "sound.SID_FEM");
  const std::filesystem::path path = folder / "bad.SID_FEM";
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_sid_fem(path);
  };
  const std::size_t Gr = sound.find("           Gr\n");
  const std::size_t entry = sound.find("m0( 1, 2)", Gr);
  CHECK_THROWS_WITH(read(std::string(sound).replace(sound.find("= ", entry) + 4, 1, "9")),
                    Contains("bad.SID_FEM: J and Gr of mode 1 differ by"));
  CHECK_THROWS_WITH(read(replaced(sound, "end mdCM", "end mdcm")),
                    Contains("expected an entry m0(i,j) or m1(i,k,j), found 'end mdcm'"));
  CHECK_THROWS_WITH(read(sound.substr(0, sound.find("           De\n"))),
                    Contains("the file ends too early"));
}

}  // namespace flexneck::fe_modal
