// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "multibody/files/history_file.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::check_refused;
using testing::CommandOutcome;
using testing::names_in;
using testing::run_flexneck;

namespace {

namespace fs = std::filesystem;

/// The coarsest neck and short runs: seconds instead of a minute.
const std::string kCoarse = std::string(testing::kCoarseNeck) + " --set pendulum.duration='0.2 s'";

}  // namespace

TEST_CASE("a run twice gives the same bytes, and knows the paper only in its verification") {
  const TemporaryFolder folder;
  const std::string first = (folder / "first").string();
  const std::string second = (folder / "second").string();
  const CommandOutcome outcome = run_flexneck("run -o " + first + kCoarse);
  INFO(outcome.text);
  REQUIRE((outcome.exit_code == 0 || outcome.exit_code == 1));  // coarse: may miss a frequency
  CHECK_THAT(outcome.text, Contains("bending 1") && Contains("torsion 2") && Contains("published"));
  std::vector<std::string> expected = {
      "mesh.h5",     "mesh.png",           "mesh.xdmf",         "mesh_view.h5",  "modes.h5",
      "modes.png",   "modes.xdmf",         "modes_view.h5",     "pendulum.json", "static.json",
      "timing.json", "pulse-spectrum.csv", "verification.json", "verdicts.json", "report.html",
      "figures",     "stages.json",        "study.json"};
  const auto add_case = [&](const std::string& name) {
    for (const char* const ending : {".csv", ".h5"}) expected.push_back(name + ending);
  };
  for (const char* const name : {"flexion", "extension", "lateral"})
    add_case("static-" + std::string(name));
  // 11 drops and the variants of them.
  std::vector<std::string> drops = {"lateral-65"};
  for (const char* const way : {"flexion-", "extension-"})
    for (const char* const angle : {"20", "40", "60", "80", "120"})
      drops.push_back(std::string(way) + angle);
  for (const std::string& drop : drops)
    for (const char* const variant : {"", "-rigid", "-equivalent"})
      add_case("pendulum-" + drop + variant);
  for (const char* const variant :
       {"flexion-20-duration", "flexion-40-duration", "extension-20-duration",
        "extension-40-duration", "flexion-20-spring", "flexion-60-spring", "flexion-120-spring",
        "lateral-65-spring", "flexion-20-rotating", "flexion-60-rotating", "flexion-120-rotating",
        "extension-120-part572", "extension-120-part572-rotating"})
    add_case("pendulum-" + std::string(variant));
  std::sort(expected.begin(), expected.end());
  CHECK(names_in(folder / "first") == expected);

  // Another table of published figures must change the verification and nothing else.
  std::ofstream(folder / "other.toml") << R"(
tolerance_percent = 1.0
bending = ["1 Hz", "2 Hz", "3 Hz", "4 Hz"]
torsion = ["5 Hz", "6 Hz"]
mode_order = ["axial"]
weight = "1 kg"
system_frequency = "1 Hz"
frequency_ratio = 1
effective_damping = 1
)";
  std::ofstream(folder / "other_study.toml")
      << "include = [\"" << FLEXNECK_SOURCE_DIR << "/pipeline/studies/hybrid3.toml\"]\n"
      << "[output]\nverification = \"other.toml\"\n";
  const CommandOutcome again =
      run_flexneck("run " + (folder / "other_study.toml").string() + " -o " + second + kCoarse);
  CHECK(again.exit_code == 1);
  const auto json_of = [&](const std::string& name) {
    return nlohmann::json::parse(bytes_of(folder / (name + "/verification.json")));
  };
  CHECK_FALSE(json_of("second")["passed"].get<bool>());
  // What a regulation says of the neck is a result, and no business of the exit code.
  CHECK_THAT(outcome.text, Contains("572.33 flexion") && Contains("572.33 extension"));
  const auto verdicts = nlohmann::json::parse(bytes_of(folder / "first/verdicts.json"));
  CHECK(verdicts["tables"][0]["name"] == "verdicts");
  CHECK(verdicts["tables"][0]["rows"].size() == 4);
  CHECK(verdicts["tables"][0]["rows"][0][3] == "FAIL");
  CHECK(verdicts["provenance"]["inputs"].dump().find("572.33.toml") != std::string::npos);
  // They are called what their file says they are.
  CHECK_THAT(again.text, Contains("Verification against synthetic figures"));
  CHECK_THAT(outcome.text, Contains("Verification against published figures"));
  CHECK(json_of("first")["rows"][0]["value"] == json_of("second")["rows"][0]["value"]);

  // The provenance names the study file, so compare what was computed.
  const CommandOutcome third = run_flexneck("run --force -o " + second + kCoarse);
  CHECK(third.text.substr(0, third.text.find(second)) ==
        outcome.text.substr(0, outcome.text.find(first)));
  for (const std::string& name : expected) {
    // Measured, and what shows it.
    if (name == "timing.json" || name == "report.html" || name == "stages.json") continue;
    INFO(name);
    if (fs::is_directory(folder / ("first/" + name))) {
      CHECK(names_in(folder / ("first/" + name)) == names_in(folder / ("second/" + name)));
      continue;
    }
    CHECK(bytes_of(folder / ("first/" + name)) == bytes_of(folder / ("second/" + name)));
  }

  // What has not changed is kept, its tables are shown again.
  const CommandOutcome kept = run_flexneck("run -o " + second + kCoarse);
  CHECK(kept.exit_code == outcome.exit_code);
  CHECK_THAT(kept.text, Contains("Nothing has changed for report: kept") && !Contains("Meshing") &&
                            Contains("Nothing has changed for 46 of 46 pendulum cases: kept") &&
                            Contains("Head/neck pendulum") && Contains("torsion 2"));
  const CommandOutcome touched =
      run_flexneck("run -o " + second + kCoarse + " --set case.flexion-60.duration='0.9 s'");
  // The case, and what four variants make of it.
  CHECK_THAT(touched.text, Contains("Nothing has changed for modes: kept") &&
                               Contains("Nothing has changed for static: kept") &&
                               Contains("Nothing has changed for 41 of 46 pendulum cases: kept") &&
                               Contains("Head/neck pendulum: flexion-60\n") &&
                               Contains("Head/neck pendulum: flexion-60-rigid\n") &&
                               !Contains("Head/neck pendulum: flexion-40") &&
                               !Contains("Nothing has changed for verify") &&
                               Contains("Writing the report"));
  CHECK(bytes_of(folder / "first/modes.h5") == bytes_of(folder / "second/modes.h5"));

  // ReferenceFacet by side they differ in that value and nothing else that they were made with.
  const std::string both = (folder / "both").string();
  const CommandOutcome compared = run_flexneck("compare " + first + " " + second + " -o " + both);
  CHECK(compared.exit_code == 0);
  CHECK_THAT(compared.text,
             Contains("case.flexion-60.duration") && Contains("0.9 s") && !Contains("geometry."));
  const auto tables = nlohmann::json::parse(bytes_of(folder / "both/comparison.json"))["tables"];
  CHECK(tables[0]["rows"].size() == 1);
  CHECK(fs::exists(folder / "both/comparison.html"));
  check_refused(run_flexneck("compare " + first), "at least two folders");
  check_refused(run_flexneck("compare " + first + " " + both + "/none"), "no such folder");
}

TEST_CASE("the mesh file holds the partitions and the order that the study asks for") {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const CommandOutcome outcome =
      run_flexneck("mesh -o " + out + kCoarse +
                   " --set mesh.partitions='[2, 3]' --set mesh.node_order=nested-dissection");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("Partition for 2 processes: edge cut") &&
                               Contains("Partition for 3 processes: edge cut"));
  const mesher::MeshFile file = mesher::read_mesh(folder / "mesh.h5");
  CHECK(file.partitions.size() == 2);
  CHECK(file.node_order.size() == file.mesh.nodes.size());
  check_refused(run_flexneck("mesh -o " + out + kCoarse + " --set mesh.partitions='[0]'"),
                "mesh.partitions: expected numbers of processes");
}

TEST_CASE("what a stage leaves is read by the next one, or refused in one line") {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  REQUIRE(run_flexneck("mesh -q -o " + out + kCoarse).exit_code == 0);
  REQUIRE(run_flexneck("modes -q -o " + out + kCoarse).exit_code == 0);
  const auto modes = fe_modal::read_modal_body(folder / "modes.h5");
  CHECK(modes.body.mode_count() == 10);
  CHECK(modes.provenance.parameters.size() > 20);

  SECTION("h5py reads the modes without help") {
    const std::string script =
        "import h5py; f = h5py.File('" + out +
        "/modes.h5'); "
        "assert f['frequencies'].shape == (10,) and f['frequencies'].attrs['units'] == b'Hz'; "
        "assert f['mode_names'].asstr()[0].endswith('bending 1'); "
        "assert f['shapes'].shape == (10, f['nodes'].shape[0], 3); "
        "assert f['interfaces/top/rotation'].shape == (3, 10); "
        "assert abs(f['interfaces/base/translation'][:]).max() == 0; "
        "assert 'published' in f['provenance/parameters/origin'].asstr()[:]";
    const CommandOutcome outcome = testing::run_shell("/usr/bin/python3 -c \"" + script + "\"");
    INFO(outcome.text);
    CHECK(outcome.exit_code == 0);
  }
  SECTION("ParaView's file shows each mode by name, and all that it refers to is there") {
    const CommandOutcome outcome =
        testing::run_shell("/usr/bin/python3 " + std::string(FLEXNECK_SOURCE_DIR) +
                           "/tests/support/check_xdmf.py " + out + "/modes.xdmf");
    INFO(outcome.text);
    CHECK(outcome.exit_code == 0);
  }
  SECTION("a stage refuses what was made with other values") {
    check_refused(run_flexneck("modes -o " + out + kCoarse + " --set geometry.length='5.7 in'"),
                  "was made with geometry.length = 5.66 in, the study has 5.7 in");
    check_refused(run_flexneck("pendulum -o " + out + kCoarse + " --set modes.count=11"),
                  "make it again with 'flexneck modes'");
    check_refused(
        run_flexneck("modes -o " + out + kCoarse + " --set modes.rigid_interfaces='[\"tip\"]'"),
        "modes.rigid_interfaces: there is no interface 'tip' (did you mean 'top'?)");
    check_refused(run_flexneck("modes -o " + out + kCoarse + " --set modes.fixed_directions.top=w"),
                  "modes.fixed_directions.top: expected directions such as \"x\" or \"yz\"");
  }
  SECTION("info tells what is in a file and what made it") {
    const CommandOutcome mesh = run_flexneck("info " + out + "/mesh.h5");
    CHECK(mesh.exit_code == 0);
    CHECK_THAT(mesh.text, Contains("flexneck mesh") && Contains("top_plate") &&
                              Contains("Node set bolts") && Contains("geometry.length"));
    const CommandOutcome told = run_flexneck("info " + out + "/modes.h5");
    CHECK_THAT(told.text, Contains("fixed: bolts") && Contains("fore-aft bending 1") &&
                              Contains("Interface top") && Contains("mesh.h5"));
    check_refused(run_flexneck("info " + out + "/mesh.xdmf"), "another kind of file");
    check_refused(run_flexneck("info " + out + "/none.h5"), "no such file");
  }
  SECTION("a stage tells what it replaces by something else, and what it was made with counts") {
    // A study that is named is taken without what the folder remembers.
    const std::string study =
        " " + std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/studies/hybrid3.toml";
    const CommandOutcome fewer = run_flexneck("modes -q" + study + " -o " + out + kCoarse +
                                              " --set modes.count=6 --set modes.basis=residual");
    CHECK(fewer.exit_code == 0);
    CHECK_THAT(fewer.text, Contains("Warning: " + out +
                                    "/modes.h5: was made with modes.count = 10, "
                                    "now with 6") &&
                               Contains("modes.h5"));
    // A key that the study does not give, of which its default holds.
    check_refused(run_flexneck("static" + study + " -o " + out + kCoarse + " --set modes.count=6"),
                  "modes.h5: was made with modes.basis = residual, the study has normal");
    CHECK(run_flexneck("modes -q" + study + " -o " + out + kCoarse).text.find("Warning") !=
          std::string::npos);
    CHECK(run_flexneck("modes -q" + study + " -o " + out + kCoarse).text.empty());
    check_refused(
        run_flexneck("static" + study + " -o " + out + kCoarse + " --set modes.basis=residual"),
        "modes.h5: was made without modes.basis, the study has residual");
  }
  SECTION("one flipped bit of a frequency is refused") {
    std::string bytes = bytes_of(folder / "modes.h5");
    const double first = modes.body.frequencies_Hz[0];
    const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&first), 8));
    REQUIRE(place != std::string::npos);
    bytes[place + 6] = static_cast<char>(bytes[place + 6] ^ 1);
    std::ofstream(folder / "modes.h5", std::ios::binary) << bytes;
    for (const std::string& command :
         {"verify -o " + out + kCoarse, "static -o " + out + kCoarse, "info " + out + "/modes.h5"})
      check_refused(run_flexneck(command), "modes.h5: the HDF5 file is truncated or damaged");
  }
  SECTION("a truncated file is refused") {
    fs::resize_file(folder / "modes.h5", fs::file_size(folder / "modes.h5") / 2);
    check_refused(run_flexneck("static -o " + out + kCoarse),
                  "modes.h5: the HDF5 file is truncated");
  }
  SECTION("a file of another stage is refused") {
    fs::copy_file(folder / "mesh.h5", folder / "modes.h5", fs::copy_options::overwrite_existing);
    check_refused(run_flexneck("static -o " + out + kCoarse),
                  "expected the format 'flexneck modal body', found 'flexneck mesh'");
  }
  SECTION("a missing file is refused") {
    fs::remove(folder / "modes.h5");
    check_refused(run_flexneck("verify -o " + out + kCoarse),
                  "modes.h5: no such file; make it with 'flexneck modes'");
  }
}

TEST_CASE("modes --certify proves that no mode is missing and estimates the mesh's error") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh -q" + out).exit_code == 0);
  const CommandOutcome outcome = run_flexneck("modes -v --certify" + out);
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("certified: no mode is missing below") &&
                               Contains("mesh error %") && Contains("seconds: read ") &&
                               Contains("factorise "));
  const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "modes.h5").body;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const auto& mode = body.modes[static_cast<std::size_t>(k)];
    if (mode.kind != "normal") continue;
    REQUIRE(mode.mesh_error.has_value());
    CHECK(mode.mesh_error->refined_Hz == Approx(body.frequencies_Hz[k]).epsilon(0.1));
    CHECK(mode.mesh_error->error < 0.2);
  }
  // Another stage does not mind.
  CHECK(run_flexneck("static -q" + out).exit_code == 0);
}

TEST_CASE("a static modulus softens the static test alone") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh -q" + out).exit_code == 0);
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  REQUIRE(run_flexneck("static -q" + out).exit_code == 0);
  // How much the tip moves while the ramp rises, once the lag that damping makes is steady.
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
  // The plates of aluminium keep their stiffness.
  CHECK(tip() / stiff == Approx(4).epsilon(0.02));
  const auto frequencies = [&](const char* file) {
    return fe_modal::read_modal_body(folder / file).body.frequencies_Hz;
  };
  CHECK(frequencies("modes_static.h5")[0] / frequencies("modes.h5")[0] ==
        Approx(0.5).epsilon(1e-3));
  // Without the ratio, which the folder remembers until it is begun anew, nothing of it is left.
  REQUIRE(run_flexneck("mesh -q" + out).exit_code == 0);
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  CHECK(bytes_of(folder / "modes.h5") == modes);
  CHECK_FALSE(fs::exists(folder / "modes_static.h5"));
}

TEST_CASE("materials that cannot be, and ones that lock, are told") {
  const TemporaryFolder folder;
  const std::string out = " -q -o " + folder.path().string() + kCoarse;
  const std::string butyl = " --set geometry.materials.butyl.";
  check_refused(run_flexneck("mesh" + out + butyl + "density='-1 kg/m^3'"),
                "material 'butyl': density must be > 0");
  check_refused(run_flexneck("mesh" + out + butyl + "density='-1e-9 kg/m^3'"), "-1e-09 kg/m^3");
  check_refused(run_flexneck("mesh" + out + butyl + "poissons_ratio=0.5"),
                "material 'butyl': Poisson's ratio must lie between -1 and 0.5");
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
  check_refused(run_flexneck("run --set geometry.plate_thickness='-0.1 in'" + out),
                "plate_thickness");
  check_refused(run_flexneck("run --set geometry.plate_thickness=0.3" + out), "with its unit");
  check_refused(run_flexneck("run --set geometry.plate_thickness='0.3 inn'" + out), "unknown unit");
  check_refused(run_flexneck("run --set mesh.quadrants=4" + out), "did you mean 'quadrant'?");
  CHECK_FALSE(fs::exists(folder / "out"));
  check_refused(run_flexneck("run --no-such-option" + out), "--no-such-option");
  CHECK(run_flexneck("--help").exit_code == 0);
  CHECK(run_flexneck("--version").exit_code == 0);
}

TEST_CASE("giants are refused before they start, with what they take and what there is") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const auto run_within_4_GB = [&](const std::string& arguments) {
    return testing::run_shell("ulimit -v 4000000; " + std::string(FLEXNECK_BINARY_DIR) +
                              "/flexneck " + arguments + out);
  };
  check_refused(run_within_4_GB("mesh --refine 30"), "a mesh of about 2.15e+08 nodes takes about");
  check_refused(run_within_4_GB("mesh --refine 2000000000"), "more degrees of freedom than");
  CHECK_FALSE(fs::exists(folder / "out"));

  const std::string coarse = std::string(testing::kCoarseNeck) + " -q";
  REQUIRE(run_within_4_GB("mesh" + coarse).exit_code == 0);
  check_refused(run_within_4_GB("modes --set modes.count=4000" + coarse),
                "take a coarser mesh or fewer modes");
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
  // The neck in mm taken for m: a remark, no refusal.
  const CommandOutcome giant = run_flexneck("mesh --show --set geometry.length='143 m'" + out);
  CHECK(giant.exit_code == 0);
  CHECK_THAT(giant.text, Contains("Warning: the largest extent is 143 m"));
  check_refused(run_flexneck("modes --show" + out), "--show belongs to the command mesh");
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
