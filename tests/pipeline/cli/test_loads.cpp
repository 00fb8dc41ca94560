// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/static_solution_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/cli/structure_runs.h"
#include "tests/support/calculix.h"
#include "tests/support/files.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::check_refused;
using testing::kExamples;
using testing::run_flexneck;

TEST_CASE("a bar under loads of every kind is in balance, and CalculiX agrees on its modes",
          "[ccx]") {
  const TemporaryFolder folder;
  const std::string study = kExamples + "loaded_bar.toml";
  testing::run_study(study, folder.path(), " --set modes.formulation=displacement");
  const fe_modal::StaticSolution solution =
      fe_modal::read_static_solution(folder / "stress.h5").solution;
  CHECK(solution.loads.size() == 5);
  const double weight = 0.81 * 9.80665;
  const Eigen::Vector3d loads(20e3, 40, -weight - 2e3 * 0.5 * 0.03);
  const fe_modal::Resultant reaction =
      fe_modal::resultant_of(solution.nodes_m, solution.reactions_N);
  CHECK((reaction.force_N + loads).norm() < 1e-6 * loads.norm());
  const Eigen::VectorXd stiffened = testing::frequencies_in(folder.path());
  const std::string out = " -o " + folder.path().string();
  const auto deck = folder / "bar.inp";
  const std::string displacement = " --set modes.formulation=displacement";
  REQUIRE(run_flexneck("export -q " + study + displacement + out + " --to " + deck.string())
              .exit_code == 0);
  // CalculiX adds the displacement stiffness, of the order of the strains: here 5e-4.
  CHECK(testing::largest_error(stiffened, testing::calculix_frequencies(deck)) < 1e-3);
  REQUIRE(run_flexneck("export -q " + (folder / "stress.h5").string() + " --to " +
                       (folder / "stress.vtu").string())
              .exit_code == 0);
  CHECK_THAT(testing::bytes_of(folder / "stress.vtu"),
             Contains("Name=\"stress of Aluminium [Pa]\" NumberOfComponents=\"9\""));
  CHECK_THAT(run_flexneck("info " + (folder / "modes.h5").string()).text,
             Contains("prestressed") && Contains("pull: face 'Tip', force (20000, 0, 0) N"));
  std::ofstream(folder / "swing.toml") << R"([solver]
end_time = "0.01 s"
[[body]]
name = "bar"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 0.01
)";
  check_refused(run_flexneck("simulate -q " + (folder / "swing.toml").string() + out),
                "prestressed by fixed loads");
}

TEST_CASE("loads that a study does not have, or no structure for, are refused") {
  const TemporaryFolder folder;
  const std::string out = " -q -o " + folder.path().string();
  const std::string bar = kExamples + "cantilever.toml";
  check_refused(run_flexneck("mesh " + bar + out + " --set modes.prestress=loads"),
                "modes.prestress: expected a [[load]]");
  REQUIRE(run_flexneck("mesh " + bar + out).exit_code == 0);
  check_refused(run_flexneck("stress " + bar + out), "expected a [[load]] for the static step");
}
