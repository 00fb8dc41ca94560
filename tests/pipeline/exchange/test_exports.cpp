// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/cli/structure_runs.h"
#include "tests/support/calculix.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::check_refused;
using testing::CommandOutcome;
using testing::frequencies_in;
using testing::kExamples;
using testing::largest_error;
using testing::run_flexneck;
using testing::run_study;
using testing::summary_of;

namespace {

namespace fs = std::filesystem;

/// Writes a study of an exported mesh, with the bar's material.
std::string imported_bar(const fs::path& folder, const std::string& file) {
  std::ofstream(folder / "again.toml") << "[geometry]\nfile = \"" << file << R"("
[geometry.materials.aluminium]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
density = "2700 kg/m^3"
parts = ["bar"]
[modes]
count = 6
fixed = ["clamp"]
[[interface]]
name = "tip"
position = ["0.5 m", "0 m", "0 m"]
)";
  return (folder / "again.toml").string();
}

}  // namespace

TEST_CASE("a mesh comes back from its export with the same frequencies") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const std::string study = kExamples + "cantilever.toml";
  run_study(study, out);
  const Eigen::VectorXd before = frequencies_in(out);
  for (const char* const how : {"", " --binary"}) {
    REQUIRE(run_flexneck("export " + study + " -o " + out.string() + " --to " +
                         (folder / "bar.msh").string() + how)
                .exit_code == 0);
    run_study(imported_bar(folder.path(), "bar.msh"), folder / "again");
    CHECK((frequencies_in(folder / "again") - before).cwiseQuotient(before).cwiseAbs().maxCoeff() <
          1e-10);
  }
  check_refused(run_flexneck("export -q " + study + " -o " + out.string() + " --to " +
                             (folder / "bar.inp").string()),
                "no element of kind hex27");
  check_refused(run_flexneck("export -q " + study + " -o " + out.string() + " --to bar.stl"),
                "expected a file with one of the extensions .msh (mesh for gmsh)");
}

TEST_CASE("an .inp comes back from its export with the same frequencies, and CalculiX agrees",
          "[ccx]") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const std::string study = kExamples + "cantilever_inp.toml";
  const std::string displacement = " --set modes.formulation=displacement";
  run_study(study, out, displacement);
  const Eigen::VectorXd before = frequencies_in(out);
  REQUIRE(run_flexneck("export " + study + displacement + " -o " + out.string() + " --to " +
                       (folder / "bar.inp").string())
              .exit_code == 0);
  std::ofstream(folder / "again.toml")
      << "[geometry]\nfile = \"bar.inp\"\n[modes]\ncount = 6\nfixed = [\"boundary\"]\n";
  run_study((folder / "again.toml").string(), folder / "again", displacement);
  const Eigen::VectorXd after = frequencies_in(folder / "again");
  CHECK((after - before).cwiseQuotient(before).cwiseAbs().maxCoeff() < 1e-10);
  // CalculiX prints seven digits.
  CHECK(largest_error(before, testing::calculix_frequencies(folder / "bar.inp")) < 1e-6);
}

TEST_CASE("CalculiX finds the neck's frequencies on the deck exported of 20-node elements",
          "[ccx]") {
  const TemporaryFolder folder;
  const std::string neck =
      " --set mesh.element=hex20 --set mesh.quadrant=2 --set mesh.inner_ring=2"
      " --set mesh.outer_ring=1 --set mesh.rubber_layers=1"
      " --set geometry.bolt_patch_radius='0.4 in' -q -o " +
      folder.path().string();
  REQUIRE(run_flexneck("mesh" + neck).exit_code == 0);
  const auto errors = [&](const std::string& formulation) {
    const std::string with = neck + " --set modes.formulation=" + formulation;
    REQUIRE(run_flexneck("modes" + with).exit_code == 0);
    const fs::path deck = folder / (formulation + ".inp");
    REQUIRE(run_flexneck("export" + with + " --to " + deck.string()).exit_code == 0);
    return largest_error(frequencies_in(folder.path()), testing::calculix_frequencies(deck));
  };
  CHECK(errors("displacement") < 1e-6);
  // For C3D20R CalculiX uses eight integration points for the mass too, flexneck full integration:
  // the short waves of so coarse a mesh differ.
  CHECK(errors("reduced") < 1e-3);
}

TEST_CASE("hexahedra, prisms and tetrahedra in one mesh: CalculiX agrees", "[ccx]") {
  const TemporaryFolder folder;
  const std::string study = kExamples + "mixed.toml";
  run_study(study, folder.path());
  const mesher::Mesh mesh = mesher::read_mesh(folder / "mesh.h5").mesh;
  CHECK(mesh.blocks.size() == 3);
  CHECK(mesh.face_set("end").blocks.size() == 1);
  CHECK(summary_of(folder.path()).mass_kg ==
        Approx(7850 * 0.26 * 0.03 * 0.02 + 1360 * 0.06 * 0.03 * 0.04).epsilon(1e-9));
  REQUIRE(run_flexneck("export " + study + " -o " + folder.path().string() + " --to " +
                       (folder / "mixed.inp").string())
              .exit_code == 0);
  // CalculiX integrates prisms and tetrahedra at fewer points.
  CHECK(largest_error(frequencies_in(folder.path()),
                      testing::calculix_frequencies(folder / "mixed.inp")) < 1e-3);
}

TEST_CASE("matrices that were exported give the frequencies of the mesh they came from") {
  const TemporaryFolder folder;
  const std::string study = kExamples + "cantilever.toml";
  run_study(study, folder.path());
  const Eigen::VectorXd truth = frequencies_in(folder.path());
  for (const std::string ending : {".mtx", ".petsc"}) {
    INFO(ending);
    const CommandOutcome exported =
        run_flexneck("export " + study + " -o " + folder.path().string() + " --to " +
                     (folder / ("bar" + ending)).string());
    INFO(exported.text);
    REQUIRE(exported.exit_code == 0);
    std::ofstream(folder / "bar.toml")
        << "[matrices]\nstiffness = \"bar_K" << ending << "\"\nmass = \"bar_M" << ending
        << "\"\nnodes = \"bar_nodes" << ending << "\"\n[modes]\ncount = " << truth.size() << "\n";
    run_study((folder / "bar.toml").string(), folder / "again");
    CHECK(frequencies_in(folder / "again").isApprox(truth, 1e-9));
  }
}

namespace {

/// A modal file of the ATB, read as that program does: numbers in free format, then the end.
struct AtbFile {
  explicit AtbFile(const fs::path& path) : stream(path) {
    std::size_t modes = 0;
    Eigen::Index nodes = 0;
    stream >> nodes >> modes;
    positions = numbers(3, nodes);
    masses = numbers(nodes, 1);
    hertz = numbers(static_cast<Eigen::Index>(modes), 1);
    for (std::size_t k = 0; k < modes; ++k) shapes.push_back(numbers(6, nodes));
    REQUIRE(stream);
    notes = {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd result(rows, columns);
    for (double& x : result.reshaped()) stream >> x;
    return result;
  }

  std::ifstream stream;
  Eigen::MatrixXd positions;  ///< (3, n)
  Eigen::MatrixXd masses;
  Eigen::MatrixXd hertz;
  std::vector<Eigen::MatrixXd> shapes;  ///< (6, n) each
  std::string notes;
};

constexpr double kInch = 0.0254;                      ///< in m
constexpr double kPoundForce = 0.45359237 * 9.80665;  ///< in N
constexpr double kMassUnit = kPoundForce / kInch;     ///< 1 lbf s^2/in in kg

/// The body's node at the position of each node of the file.
std::vector<Eigen::Index> nodes_at(const AtbFile& file, const fe_modal::ModalBody& body) {
  std::vector<Eigen::Index> nodes;
  for (const auto& position : file.positions.colwise()) {
    Eigen::Index node = 0;
    const double distance = (body.nodes_m.colwise() - Eigen::Vector3d(kInch * position))
                                .colwise()
                                .norm()
                                .minCoeff(&node);
    CHECK(distance < 1e-14);
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

TEST_CASE("the ATB's modal file holds the modes, normalised as that program does it") {
  const TemporaryFolder folder;
  const std::string arguments = kExamples + "cantilever.toml -o " + folder.path().string();
  run_study(kExamples + "cantilever.toml", folder.path());
  const CommandOutcome outcome =
      run_flexneck("export " + arguments + " --to " + (folder / "bar.dat").string());
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const AtbFile file(folder / "bar.dat");
  const auto body = fe_modal::read_modal_body(folder / "modes.h5").body;
  REQUIRE(file.shapes.size() == 4);
  CHECK(file.hertz == body.frequencies_Hz.head(4));
  CHECK(kMassUnit * file.masses.sum() == Approx(0.81).epsilon(1e-9));
  CHECK(file.masses.minCoeff() > 0);
  CHECK((kInch * file.positions.row(0) * file.masses).value() / file.masses.sum() ==
        Approx(0.25).epsilon(1e-9));  // the centre of the bar
  CHECK_THAT(file.notes, Contains("Inferred") && Contains(body.modes[3].name));

  const std::vector<Eigen::Index> nodes = nodes_at(file, body);
  const fe_modal::Interface& tip = body.interface("tip");
  for (std::size_t k = 0; k < 4; ++k) {
    INFO(body.modes[k].name);
    const Eigen::MatrixXd translations = file.shapes[k].topRows(3);
    CHECK((translations.colwise().squaredNorm() * file.masses).value() == Approx(1).epsilon(1e-12));
    // With the consistent mass the modal mass is 1 kg: lumping changes it slightly.
    const Eigen::MatrixXd expected = body.shapes[k](Eigen::all, nodes) * std::sqrt(kMassUnit);
    const double scale = translations.norm() / expected.norm();
    CHECK(scale == Approx(1).epsilon(0.02));
    CHECK((translations - scale * expected).norm() < 1e-12 * translations.norm());
    // The end is free and stays plane, except for Poisson's effect: its rotation equals each
    // corner's.
    const Eigen::Vector3d rotation =
        scale * std::sqrt(kMassUnit) * kInch * tip.rotation.col(static_cast<Eigen::Index>(k));
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (body.nodes_m(0, nodes[n]) < 0.5 - 1e-9) continue;
      const Eigen::Vector3d corner = file.shapes[k].col(static_cast<Eigen::Index>(n)).tail(3);
      CHECK((corner - rotation).norm() < 0.02 * rotation.norm());
    }
  }
}
