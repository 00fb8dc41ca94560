// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::check_refused;
using testing::CommandOutcome;
using testing::run_flexneck;

namespace {

namespace fs = std::filesystem;

/// The coarsest neck and short runs: seconds instead of a minute.
const std::string kCoarse = std::string(testing::kCoarseNeck) + " --set pendulum.duration='0.2 s'";

}  // namespace

TEST_CASE("modes --check checks that no mode is missing and estimates the mesh's error") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh -q" + out).exit_code == 0);
  const CommandOutcome outcome = run_flexneck("modes -v --check" + out);
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("checked: no mode is missing below") &&
                               Contains("indicated error %") && Contains("seconds: read ") &&
                               Contains("factorise "));
  const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "modes.h5").body;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const auto& mode = body.modes[static_cast<std::size_t>(k)];
    if (mode.kind != "normal") continue;
    REQUIRE(mode.mesh_error.has_value());
    CHECK(mode.mesh_error->refined_Hz == Approx(body.frequencies_Hz[k]).epsilon(0.1));
    CHECK(mode.mesh_error->error < 0.2);
  }
  // Another stage is not affected.
  CHECK(run_flexneck("static -q" + out).exit_code == 0);
}

TEST_CASE("a static modulus softens the static test alone") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh -q" + out).exit_code == 0);
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  REQUIRE(run_flexneck("static -q" + out).exit_code == 0);
  // Motion of the tip while the ramp rises, once the lag by damping is steady.
  const auto tip = [&] {
    const auto top =
        multibody::read_history(folder / "static-flexion.h5").history.marker("neck.top");
    return top.position_m(0, 300) - top.position_m(0, 200);
  };
  const std::string modes = bytes_of(folder / "modes.h5");
  const double stiff = tip();
  const std::string quarter = " --set geometry.materials.butyl.static_modulus_ratio=0.25";
  const CommandOutcome outcome = run_flexneck("modes" + out + quarter);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK(fs::exists(folder / "modes_static.h5"));
  REQUIRE(run_flexneck("static -q" + out + quarter).exit_code == 0);
  // The aluminium plates keep their stiffness.
  CHECK(tip() / stiff == Approx(4).epsilon(0.02));
  const auto frequencies = [&](const char* file) {
    return fe_modal::read_modal_body(folder / file).body.frequencies_Hz;
  };
  CHECK(frequencies("modes_static.h5")[0] / frequencies("modes.h5")[0] ==
        Approx(0.5).epsilon(1e-3));
  // The ratio applied to these commands only: without it no effect remains.
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  CHECK(bytes_of(folder / "modes.h5") == modes);
  CHECK_FALSE(fs::exists(folder / "modes_static.h5"));
}

TEST_CASE("materials that cannot be, and ones that lock, are told") {
  const TemporaryFolder folder;
  const std::string out = " -q -o " + folder.path().string() + kCoarse;
  const std::string butyl = " --set geometry.materials.butyl.";
  check_refused(run_flexneck("mesh" + out + butyl + "density='-1 kg/m^3'"),
                "geometry.materials.butyl.density: expected a positive value, found -1");
  check_refused(run_flexneck("mesh" + out + butyl + "density='-1e-9 kg/m^3'"), "found -1e-09");
  check_refused(run_flexneck("mesh" + out + butyl + "poissons_ratio=0.5"),
                "poissons_ratio: expected a value between -1 and 0.5, found 0.5");
  check_refused(run_flexneck("mesh" + out + butyl + "static_modulus_ratio=0"),
                "static_modulus_ratio: expected a positive value, found 0");
  check_refused(run_flexneck("mesh" + out + butyl + "formulation=mixd"),
                "unknown formulation 'mixd'");
  REQUIRE(run_flexneck("mesh" + out).exit_code == 0);
  const CommandOutcome outcome = run_flexneck("modes -o " + folder.path().string() + kCoarse +
                                              butyl + "formulation=displacement");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("Warning: material 'butyl' with Poisson's ratio 0.49"));
}

TEST_CASE("unusable arguments and studies end with one line, exit code 2 and no file") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  std::ofstream(folder / "broken.toml") << "[geometry\nlength = 1\n";
  check_refused(run_flexneck("pendulm" + out),
                "there is no command 'pendulm' (did you mean 'pendulum'?)");
  check_refused(run_flexneck("run " + (folder / "none.toml").string() + out),
                "none.toml: no such file");
  check_refused(run_flexneck("run " + (folder / "broken.toml").string() + out),
                "broken.toml:1:10:");
  for (const char* const name : {"my.inp", "my.BDF", "my.step", "my.msh", "my.unv"}) {
    std::ofstream(folder / name) << "*NODE\n";
    check_refused(run_flexneck("run " + (folder / name).string() + out),
                  std::string("found a mesh or shape file, by its extension; write a study, such "
                              "as my.toml, with file = \"") +
                      name + "\" in [geometry]");
  }
  check_refused(run_flexneck("simulate " + (folder / "my.inp").string() + out),
                "file = \"my.inp\"");
  check_refused(run_flexneck("run --set geometry.plate_thickness='-0.1 in'" + out),
                "plate_thickness");
  check_refused(run_flexneck("run --set geometry.plate_thickness=0.3" + out), "with its unit");
  check_refused(run_flexneck("run --set geometry.plate_thickness='0.3 inn'" + out), "unknown unit");
  check_refused(run_flexneck("run --set mesh.quadrants=4" + out), "did you mean 'quadrant'?");
  CHECK_FALSE(fs::exists(folder / "out"));
  check_refused(run_flexneck("run --no-such-option" + out), "--no-such-option");
  CHECK(run_flexneck("--help").exit_code == 0);
  CHECK(run_flexneck("").exit_code == 0);
  CHECK(run_flexneck("").text == run_flexneck("--help").text);
  CHECK(run_flexneck("--version").exit_code == 0);
}

TEST_CASE("giants are refused before they start, with what they take and what there is") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const auto run_within_4_GB = [&](const std::string& arguments) {
    return testing::run_shell("ulimit -v 4000000; " + std::string(FLEXNECK_BINARY_DIR) +
                              "/flexneck " + arguments + out);
  };
  check_refused(run_within_4_GB("mesh --refine 30"), "a mesh of about 2.15e+08 nodes needs about");
  check_refused(run_within_4_GB("mesh --refine 2000000000"), "more degrees of freedom than");
  CHECK_FALSE(fs::exists(folder / "out"));

  const std::string coarse = std::string(testing::kCoarseNeck) + " -q";
  REQUIRE(run_within_4_GB("mesh" + coarse).exit_code == 0);
  check_refused(run_within_4_GB("modes --set modes.count=4000" + coarse),
                "use a coarser mesh or fewer modes");
  check_refused(run_within_4_GB("modes --set modes.count=100000" + coarse), "found 100000");
  CHECK_FALSE(fs::exists(folder / "out/modes.h5"));
}

TEST_CASE("mesh --dry-run tells dimensions, mass and section of the neck and makes nothing") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const CommandOutcome outcome = run_flexneck("mesh --dry-run --preset paper" + out);
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "out"));
  for (const char* shown :
       {"plate_diameter", "3.4 in", "published", "calibrated", "height of each rubber section",
        "0.7548 in", "2.726 lb", "centre of gravity", "inertia about the c.g.", "front",
        "2400 elements"}) {
    CHECK_THAT(outcome.text, Contains(shown));
  }
  CHECK_THAT(outcome.text, Contains("####") && Contains("::::"));
  // The neck in mm taken for m causes a remark, no refusal.
  const CommandOutcome giant = run_flexneck("mesh --show --set geometry.length='143 m'" + out);
  CHECK(giant.exit_code == 0);
  CHECK_THAT(giant.text, Contains("Warning: the largest extent is 143 m"));
  check_refused(run_flexneck("modes --show" + out), "--show is an option of the command mesh");
  check_refused(run_flexneck("mesh --refine=-1" + out), "a whole number of at least 0");
}

TEST_CASE("what cannot be printed is a failure") {
  const auto check = [](const std::string& arguments, const std::string& reason) {
    const CommandOutcome outcome =
        testing::run_shell("(" + testing::flexneck_program() + " " + arguments + ")");
    INFO(arguments);
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.text == "flexneck: standard output: cannot be written (" + reason + ")\n");
  };
  for (const std::string command : {"study", "--help", "--version"}) {
    check(command + " > /dev/full", "No space left on device");
    check(command + " >&-", "Bad file descriptor");
  }
}

TEST_CASE("a geometry script with an error is told in gmsh's words, without a file") {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.geo") << "length = ;\n";
  const CommandOutcome outcome =
      run_flexneck("mesh -q -o " + (folder / "out").string() +
                   " --set geometry.script=" + (folder / "bad.geo").string());
  INFO(outcome.text);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.text, Contains("bad.geo"));
  CHECK_FALSE(fs::exists(folder / "out/mesh.h5"));
}
