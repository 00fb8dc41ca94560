// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/point_mass_body.h"

namespace flexneck::fe_modal {
namespace {

/// A body in which no two numbers are alike, so that an exchange shows.
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

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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
  CHECK(found.certificate == expected.certificate);
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
