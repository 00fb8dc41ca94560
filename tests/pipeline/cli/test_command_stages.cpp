// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
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
                "mesh.partitions: expected whole numbers of processes");
}

TEST_CASE(
    "kernels of the BLAS change frequencies by rounding alone, and the modes file names them") {
  const TemporaryFolder folder;
  const std::string arguments = " -q -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh" + arguments).exit_code == 0);
  REQUIRE(run_flexneck("modes" + arguments).exit_code == 0);
  const auto own = fe_modal::read_modal_body(folder / "modes.h5");
  CHECK_THAT(own.provenance.libraries.at("BLAS"), Contains("OpenBLAS"));
  // OPENBLAS_CORETYPE selects code that every x86-64 processor can run: the user's setting is
  // obeyed.
  const CommandOutcome outcome = testing::run_shell(
      "OPENBLAS_CORETYPE=Prescott " + testing::flexneck_program() + " modes" + arguments);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const auto oldest = fe_modal::read_modal_body(folder / "modes.h5");
#ifdef __x86_64__
  CHECK_THAT(oldest.provenance.libraries.at("BLAS"), Contains("Prescott"));
#endif
  const Eigen::VectorXd& expected = own.body.frequencies_Hz;
  CHECK((oldest.body.frequencies_Hz - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff() <
        1e-9);
}

TEST_CASE("modes are the same to the last bit by any number of threads") {
  const TemporaryFolder folder;
  const std::string arguments = " -q -o " + folder.path().string() + kCoarse;
  REQUIRE(run_flexneck("mesh" + arguments).exit_code == 0);
  const auto body_by = [&](int threads) {
    const CommandOutcome outcome =
        run_flexneck("modes" + arguments + " --threads " + std::to_string(threads));
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
    return fe_modal::read_modal_body(folder / "modes.h5").body;
  };
  const fe_modal::ModalBody one = body_by(1);
  const fe_modal::ModalBody three = body_by(3);
  CHECK(one.frequencies_Hz == three.frequencies_Hz);
  CHECK(one.shapes == three.shapes);
  check_refused(run_flexneck("modes" + arguments + " --threads 0"), "--threads");
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
                  "was made with geometry.length = 5.66 in, but the study has 5.7 in");
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
  SECTION("a stage tells what it replaces by another dimension, and what it was made with counts") {
    // A study given by name is used without the values that the folder remembers.
    const std::string study =
        " " + std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/studies/hybrid3.toml";
    const CommandOutcome fewer = run_flexneck("modes -q" + study + " -o " + out + kCoarse +
                                              " --set modes.count=6 --set modes.basis=residual");
    CHECK(fewer.exit_code == 0);
    CHECK_THAT(fewer.text, Contains("Warning: " + out +
                                    "/modes.h5: was made with modes.count = 10, "
                                    "now with 6") &&
                               Contains("modes.h5"));
    // A key that the study does not give has its default.
    check_refused(run_flexneck("static" + study + " -o " + out + kCoarse + " --set modes.count=6"),
                  "modes.h5: was made with modes.basis = residual, but the study has normal");
    CHECK(run_flexneck("modes -q" + study + " -o " + out + kCoarse).text.find("Warning") !=
          std::string::npos);
    CHECK(run_flexneck("modes -q" + study + " -o " + out + kCoarse).text.empty());
    check_refused(
        run_flexneck("static" + study + " -o " + out + kCoarse + " --set modes.basis=residual"),
        "modes.h5: was made without modes.basis, but the study has residual");
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
