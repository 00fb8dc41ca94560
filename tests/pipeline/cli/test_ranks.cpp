// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "tests/pipeline/parameter_studies/sweep/sweep_runs.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::check_refused;
using testing::CommandOutcome;
using testing::run_flexneck;

namespace {

/// Runs a command by mpirun and removes mpirun's own messages on a failed process. Open MPI 4 has
/// an option for that; the messages of Open MPI 5 stand between lines of dashes.
CommandOutcome run_by_mpi(const std::string& processes) {
  CommandOutcome outcome = testing::run_shell(
      "timeout 100 env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 "
      "OMPI_MCA_orte_execute_quiet=1 OMPI_MCA_btl=^tcp mpirun --oversubscribe " +
      processes);
  const std::string line = std::string(74, '-') + '\n';
  for (auto begin = outcome.text.find(line); begin != std::string::npos;
       begin = outcome.text.find(line)) {
    const auto end = outcome.text.find(line, begin + line.size());
    if (end == std::string::npos) break;
    outcome.text.erase(begin, end + line.size() - begin);
  }
  return outcome;
}

CommandOutcome run_on_two_ranks(const std::string& arguments) {
  return run_by_mpi("-n 2 " + testing::flexneck_program() + " " + arguments);
}

void require_success(const CommandOutcome& outcome) {
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

/// Checks that two bodies are equal except for rounding.
void check_same(const fe_modal::ModalBody& one, const fe_modal::ModalBody& other) {
  REQUIRE(one.mode_count() == other.mode_count());
  for (Eigen::Index k = 0; k < one.mode_count(); ++k) {
    const auto mode = static_cast<std::size_t>(k);
    INFO(one.modes[mode].name);
    CHECK(other.frequencies_Hz[k] == Approx(one.frequencies_Hz[k]).epsilon(1e-9));
    CHECK(one.modes[mode].name == other.modes[mode].name);
    // Tolerance of the eigensolver over the relative distance of the closest frequencies.
    CHECK((one.shapes[mode] - other.shapes[mode]).norm() < 1e-6 * one.shapes[mode].norm());
    CHECK(other.modes[mode].residual < 1e-6);
  }
  CHECK(other.invariants.mass == Approx(one.invariants.mass).epsilon(1e-12));
  CHECK(other.orthogonality < 1e-9);
}

}  // namespace

TEST_CASE("two ranks find the frequencies, signs and names that one finds") {
  const TemporaryFolder folder;
  const std::string arguments = " -o " + folder.path().string() + testing::kCoarseNeck;
  require_success(run_flexneck("mesh -q" + arguments));
  require_success(run_flexneck("modes -q" + arguments));
  const auto one = fe_modal::read_modal_body(folder / "modes.h5").body;
  std::filesystem::remove(folder / "modes.h5");
  const CommandOutcome outcome = run_on_two_ranks("modes -v" + arguments);
  require_success(outcome);
  CHECK_THAT(outcome.text, Contains("on 2 ranks"));
  const auto first = outcome.text.find("Modes: ");
  REQUIRE(first != std::string::npos);
  CHECK(outcome.text.find("Modes: ", first + 1) == std::string::npos);  // rank 0 alone prints
  check_same(one, fe_modal::read_modal_body(folder / "modes.h5").body);
}

TEST_CASE("what is wrong is said once on two ranks, and both end") {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  check_refused(run_on_two_ranks("modes -q -o " + out), "mesh.h5");
  check_refused(run_on_two_ranks("nonsense -q -o " + out), "nonsense");
  require_success(run_on_two_ranks(std::string("mesh -q -o ") + out + testing::kCoarseNeck));
  check_refused(run_on_two_ranks(std::string("modes -q -o ") + out + testing::kCoarseNeck +
                                 " --set modes.count=100000"),
                "100000");
}

TEST_CASE("ranks that are asked for different things say so in one line, and all end") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  require_success(run_flexneck("mesh -q" + out + testing::kCoarseNeck));
  const std::string rank = "-n 1 " + testing::flexneck_program() + " ";
  const std::string modes = "modes -q" + out;
  for (const std::string& other :
       {modes + " --set modes.count=3", modes + " --set modes.check=true",
        modes + " --set modes.basis=residual", modes + " --solver mumps", "mesh -q" + out,
        "info" + folder.path().string(), modes + " --nonsense", std::string("--help")}) {
    INFO(other);
    check_refused(run_by_mpi(rank + modes + " : " + rank + other),
                  "rank 1 was given the command line '" + other);
    check_refused(run_by_mpi(rank + other + " : " + rank + modes),
                  "rank 1 was given the command line '" + modes);
  }
  // Both commands are equal, but each finds another study in its folder.
  for (const char* const name : {"one", "two"}) {
    std::filesystem::create_directory(folder / name);
    testing::write_test_file(folder / (std::string(name) + "/study.toml"),
                             "include = [\"hybrid3\"]\n[modes]\ncount = " +
                                 std::to_string(name == std::string("one") ? 4 : 5) + "\n");
  }
  const auto in_folder = [&](const std::string& name) {
    return "-n 1 --wdir " + (folder / name).string() + " " + testing::flexneck_program() +
           " modes study.toml -q" + out;
  };
  check_refused(run_by_mpi(in_folder("one") + " : " + in_folder("two")),
                "reads other values than rank 0");
}

TEST_CASE("ranks as few as elements work, also without free nodes, and more are refused") {
  const TemporaryFolder folder;
  std::string text = "*NODE\n";
  for (int level = 0, node = 1; level < 3; ++level) {
    for (const char* const corner : {"0,0,", "1,0,", "1,1,", "0,1,"})
      text += std::to_string(node++) + "," + corner + std::to_string(level) + "\n";
  }
  const auto write = [&](const std::string& elements) {
    testing::write_test_file(folder / "bar.inp",
                             text + "*ELEMENT,TYPE=C3D8,ELSET=bar\n" + elements +
                                 "*MATERIAL,NAME=steel\n*ELASTIC\n2.1e11,0.3\n*DENSITY\n7850\n"
                                 "*SOLID SECTION,ELSET=bar,MATERIAL=steel\n"
                                 "*NSET,NSET=lower\n1,2,3,4,5,6,7,8\n");
  };
  const std::string study =
      testing::write_test_file(folder / "bar.toml",
                               "[geometry]\nfile = \"bar.inp\"\nunit = \"m\"\n"
                               "[modes]\ncount = 3\nfixed = [\"lower\"]\n")
          .string();
  const std::string arguments = " -q " + study + " -o " + folder.path().string();
  write("1,1,2,3,4,5,6,7,8\n2,5,6,7,8,9,10,11,12\n");
  require_success(run_flexneck("mesh" + arguments));
  require_success(run_flexneck("modes" + arguments));
  const fe_modal::ModalBody one = fe_modal::read_modal_body(folder / "modes.h5").body;
  require_success(run_on_two_ranks("modes" + arguments));
  const fe_modal::ModalBody two = fe_modal::read_modal_body(folder / "modes.h5").body;
  CHECK((two.frequencies_Hz - one.frequencies_Hz).norm() < 1e-9 * one.frequencies_Hz.norm());
  check_refused(run_on_two_ranks("modes --set modes.solver=cholmod" + arguments),
                "the solver cholmod runs on one process only; use mumps on several ranks");
}

TEST_CASE("loads of a study on two ranks: the first one makes the static step") {
  const TemporaryFolder folder;
  const std::string arguments =
      std::string(FLEXNECK_SOURCE_DIR) + "/geometry/examples/loaded_bar.toml -q -o ";
  require_success(run_flexneck("run " + arguments + (folder / "one").string()));
  require_success(run_on_two_ranks("run " + arguments + (folder / "two").string()));
  check_same(fe_modal::read_modal_body(folder / "one/modes.h5").body,
             fe_modal::read_modal_body(folder / "two/modes.h5").body);
  CHECK(std::filesystem::exists(folder / "two/stress.h5"));
}

TEST_CASE("what fails on the second rank only is said once by the first, and both end") {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  require_success(run_flexneck("mesh -q -o " + out + testing::kCoarseNeck));
  // The second rank has the first element, whose centre node is moved far outside.
  mesher::MeshFile file = mesher::read_mesh(folder / "mesh.h5");
  file.mesh.nodes[static_cast<std::size_t>(file.mesh.blocks[0].nodes[26])][2] += 1;
  std::size_t elements = 0;
  for (const mesher::ElementBlock& block : file.mesh.blocks) elements += block.size();
  std::vector<std::int32_t>& ranks = file.partitions[2];
  ranks.assign(elements, 0);
  std::fill_n(ranks.begin(), elements / 2, 1);
  mesher::write_mesh(folder / "mesh.h5", file);
  check_refused(run_on_two_ranks("modes -q -o " + out + testing::kCoarseNeck), "base_plate", 3);
}

TEST_CASE("two ranks are shards of a sweep, whose table one rank makes, too") {
  const TemporaryFolder folder;
  const std::filesystem::path study = testing::write_beam_study(folder.path(), testing::kHypercube);
  require_success(run_flexneck(testing::sweep(study, folder / "one")));
  require_success(run_on_two_ranks(testing::sweep(study, folder / "two")));
  CHECK(std::filesystem::exists(folder / "two/sweep-shards/2-of-2/rows.txt"));
  CHECK(testing::table_in(folder / "two") == testing::table_in(folder / "one"));
  const CommandOutcome refused =
      run_on_two_ranks(testing::sweep(study, folder / "two", "--shard 1/2"));
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.text, Contains("not allowed under mpirun"));
  const std::string one =
      "-n 1 " + testing::flexneck_program() + " -q " + testing::sweep(study, folder / "three");
  for (const std::string& other :
       {one + " --set modes.count=4", "-n 1 " + testing::flexneck_program() + " keys"}) {
    INFO(other);
    const CommandOutcome mixed = run_by_mpi(one + " : " + other);
    CHECK(mixed.exit_code == 2);
    CHECK_THAT(mixed.text, Contains("expected one command line"));
  }
}
