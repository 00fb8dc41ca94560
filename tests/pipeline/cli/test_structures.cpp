// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/language/study/study.h"
#include "tests/pipeline/cli/structure_runs.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::check_refused;
using testing::CommandOutcome;
using testing::frequencies_in;
using testing::kExamples;
using testing::run_flexneck;
using testing::run_study;
using testing::summary_of;

TEST_CASE("a cantilever from a script, an .inp and a .msh has the frequencies of a beam") {
  // Euler and Bernoulli: w = (b / L)^2 sqrt(E I / m'), b = 1.8751, 4.6941. L / h = 25: shear and
  // rotary inertia lower the second pair by up to 1.5 %, coarse elements raise it by about as much.
  const auto beam = [](double root, double height) {
    return root * root / (2 * std::numbers::pi * 0.25) * height * std::sqrt(70e9 / 12 / 2700);
  };
  for (const char* const study : {"cantilever", "cantilever_inp", "cantilever_msh"}) {
    INFO(study);
    const TemporaryFolder folder;
    run_study(kExamples + study + ".toml", folder.path());
    const Eigen::VectorXd computed = frequencies_in(folder.path());
    CHECK(computed[0] == Approx(beam(1.87510407, 0.02)).epsilon(0.015));
    CHECK(computed[1] == Approx(beam(1.87510407, 0.03)).epsilon(0.015));
    CHECK(computed[2] == Approx(beam(4.69409113, 0.02)).epsilon(0.015));
    CHECK(computed[3] == Approx(beam(4.69409113, 0.03)).epsilon(0.025));
    CHECK(summary_of(folder.path()).mass_kg == Approx(0.81).epsilon(1e-9));
    const auto modes = fe_modal::read_modal_body(folder / "modes.h5");
    CHECK(modes.body.interfaces.size() == 1);
    // A cantilever of mass m moves at its tip with 2 / sqrt(m) in every bending mode.
    CHECK(modes.body.interface("tip").translation.col(0).norm() ==
          Approx(2 / std::sqrt(0.81)).epsilon(2e-3));
  }
}

TEST_CASE("a seat back's frame weighs what it must and swings slower with a head restraint") {
  const TemporaryFolder folder;
  run_study(kExamples + "seat_back.toml", folder.path());
  CHECK(summary_of(folder.path()).mass_kg ==
        Approx(7850 * 0.025 * 0.025 * (2 * 0.6 + 2 * 0.4)).epsilon(1e-9));
  const auto modes = fe_modal::read_modal_body(folder / "modes.h5").body;
  REQUIRE(modes.attached.size() == 1);
  CHECK(modes.attached[0].frequencies_Hz[0] < modes.frequencies_Hz[0]);
  // Fore-aft, two clamped posts bend with the mass of the upper rail and half of their own: the
  // frame cannot be stiffer than with rigid rails, nor as slow as without the lower rail's mass.
  const double post = 7850 * 0.025 * 0.025 * 0.6;
  const double stiffness = 2 * 3 * 210e9 * std::pow(0.025, 4) / 12 / std::pow(0.6, 3);
  const double tip_mass = post / 0.6 * 0.4 + 2 * 0.2427 * post;
  const double rayleigh = std::sqrt(stiffness / tip_mass) / (2 * std::numbers::pi);
  CHECK(modes.frequencies_Hz[0] == Approx(rayleigh).epsilon(0.05));
}

TEST_CASE("a script in millimetres or inches gives the bar of the script in metres") {
  const TemporaryFolder folder;
  for (const std::string unit : {"mm", "in"}) {
    const CommandOutcome outcome =
        run_flexneck("mesh --set geometry.unit=" + unit +
                     " --set 'geometry.constants={length=\"0.5 m\", width=\"30 mm\", "
                     "height=\"20 mm\"}' " +
                     kExamples + "cantilever.toml -o " + folder.path().string());
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.text, !Contains("Warning"));
    CHECK(summary_of(folder.path()).mass_kg == Approx(0.81).epsilon(1e-9));
  }
}

TEST_CASE("masses and supports of a Nastran deck hold and load the structure, exit 0") {
  const TemporaryFolder folder;
  std::ofstream(folder / "deck.bdf") << "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\n"
                                        "GRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\n"
                                        "GRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
                                        "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n"
                                        "CONM2,2,7,,5.\nSPC1,1,123,1,2,3,4\nENDDATA\n";
  std::ofstream(folder / "deck.toml") << "[geometry]\nfile = \"deck.bdf\"\n"
                                         "[geometry.materials.steel]\n"
                                         "youngs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n"
                                         "density = \"7850 kg/m^3\"\nparts = [\"volume_1\"]\n";
  const CommandOutcome outcome = run_flexneck("mesh -q " + (folder / "deck.toml").string() +
                                              " -o " + (folder / "out").string());
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, !Contains("Warning"));
  const CommandOutcome modes =
      run_flexneck("modes " + (folder / "deck.toml").string() + " -o " + (folder / "out").string());
  CHECK(modes.exit_code == 0);
  CHECK_THAT(modes.text, Contains("fixed: SPC1 1") && Contains("mass 7855 kg"));
}

TEST_CASE("a run of a structure ends with a report of what it has, without the paper's sections") {
  const TemporaryFolder folder;
  run_study(kExamples + "cantilever.toml", folder.path());
  const std::string page = testing::bytes_of(folder / "report.html");
  CHECK_THAT(page, Contains("<h2 id=\"modes-title\">") && Contains("<h2 id=\"view-title\">") &&
                       Contains("cantilever.toml") && Contains("href=\"#inputs\""));
  CHECK_THAT(page, !Contains("id=\"figures\"") && !Contains("id=\"verification\"") &&
                       !Contains("fore-aft"));
}

TEST_CASE("the neck is what its script makes of the same constants, as of any other structure") {
  const TemporaryFolder folder;
  const std::vector<std::string> coarse = {"mesh.rubber_layers=1", "mesh.inner_ring=2",
                                           "modes.count=4", "modes.fixed=[\"base\"]",
                                           "interface.base.set=base"};
  const pipeline::Study neck = pipeline::read_study(pipeline::built_in_study(), coarse);
  std::string settings;
  for (const std::string& setting : coarse) settings += " --set '" + setting + "'";
  const std::string out = " -o " + (folder / "neck").string() + settings;
  REQUIRE(run_flexneck("mesh" + out).exit_code == 0);
  REQUIRE(run_flexneck("modes" + out).exit_code == 0);

  const auto& script = std::get<mesher::ScriptMeshOptions>(neck.structure->source);
  std::ofstream study(folder / "script.toml");
  study << "[geometry]\nscript = \"" << script.script.string() << "\"\n[geometry.constants]\n"
        << std::setprecision(17);
  for (const auto& [name, value] : script.constants) study << name << " = " << value << "\n";
  for (const mesher::Material& material : script.materials) {
    study << "[geometry.materials." << material.name << "]\nyoungs_modulus = \""
          << material.youngs_modulus_Pa << " Pa\"\npoissons_ratio = " << material.poissons_ratio
          << "\ndensity = \"" << material.density_kg_m3 << " kg/m^3\"\nparts = [";
    for (const auto& [part, of] : script.material_of_part)
      if (of == material.name) study << '"' << part << "\", ";
    study << "]\n";
  }
  study << "[modes]\ncount = 4\nfixed = [\"base\"]\n";
  study.close();
  run_study((folder / "script.toml").string(), folder / "script");
  CHECK(frequencies_in(folder / "script") == frequencies_in(folder / "neck"));
}

TEST_CASE("an interface needs a face set, or a node set that is fixed") {
  const TemporaryFolder folder;
  const std::string out = " -q -o " + folder.path().string();
  REQUIRE(run_flexneck("mesh" + out).exit_code == 0);
  check_refused(run_flexneck("modes --set 'modes.fixed=[]'" + out),
                "interface.base.set: there is no face set 'bolts'");
}

TEST_CASE(
    "weight densities and decks without pressures are warned about, supports of a deck hold") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  const std::string study = kExamples + "cantilever_inp.toml" + out;
  CHECK_THAT(run_flexneck("run " + study).text, !Contains("Warning"));
  const TemporaryFolder of_deck;
  CHECK_THAT(run_flexneck("run --set 'modes.fixed=[]' " + kExamples + "cantilever_inp.toml -o " +
                          of_deck.path().string())
                 .text,
             Contains("fixed: *BOUNDARY") && !Contains("Warning"));
  CHECK_THAT(
      run_flexneck("modes --set 'modes.fixed=[]' --set modes.deck_supports=false " + study).text,
      Contains("Modes: free"));
  CHECK_THAT(run_flexneck("export " + study + " --to " + (folder / "bar.inp").string()).text,
             Contains("Warning: ") &&
                 Contains("bar.inp: the formulation mixed_pressure is not carried over") &&
                 Contains("Aluminium (Poisson's ratio 0.33)"));
  CHECK_THAT(run_flexneck("export --set modes.formulation=displacement " + study + " --to " +
                          (folder / "bar.inp").string())
                 .text,
             !Contains("Warning"));
  // Aluminium by its weight in lbf/in^3, in a deck of inches and pounds-force.
  const CommandOutcome weighed =
      run_flexneck("mesh --set geometry.materials.aluminium.density='1.048e6 kg/m^3' " + kExamples +
                   "cantilever.toml" + out);
  CHECK(weighed.exit_code == 0);
  CHECK_THAT(weighed.text, Contains("Warning: material 'aluminium': the density is 1.048e+06") &&
                               Contains("a weight density in lbf/in^3"));
  check_refused(
      run_flexneck("mesh -q --set geometry.materials.aluminium.density='0.0975 lbf/in^3' " +
                   kExamples + "cantilever.toml" + out),
      "geometry.materials.aluminium.density");
}

TEST_CASE(
    "a Poisson's ratio at which rounding spoils the frequencies is warned about, then refused") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& poissons_ratio) {
    return run_flexneck("run " + kExamples + "cantilever.toml -o " + folder.path().string() +
                        " --set geometry.materials.aluminium.poissons_ratio=" + poissons_ratio);
  };
  CHECK_THAT(run("0.499").text, !Contains("rounding"));
  const CommandOutcome warned = run("0.499999");
  CHECK(warned.exit_code == 0);
  CHECK_THAT(warned.text, Contains("Warning: rounding moves the first frequency by"));
  const CommandOutcome refused = run("0.4999999999");
  INFO(refused.text);
  CHECK(refused.exit_code == 3);
  CHECK_THAT(refused.text, Contains("Poisson's ratio of 'aluminium' is 0.4999999999"));
}

TEST_CASE("a wrong unit is noticed, and wrong names are refused with near ones") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const std::string study = kExamples + "cantilever_msh.toml" + out;
  const CommandOutcome metres = run_flexneck("mesh --set geometry.unit=m " + study);
  CHECK(metres.exit_code == 0);
  CHECK_THAT(metres.text, Contains("Warning: the largest extent is 500 m; were millimetres"));
  CHECK_THAT(run_flexneck("mesh " + study).text, !Contains("Warning"));
  check_refused(run_flexneck("modes -q --set 'modes.fixed=[\"clmp\"]' " + study),
                "did you mean 'clamp'");
  std::ofstream(folder / "apart.geo") << R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
MeshSize {:} = 1;
Physical Volume("bar") = {1, 2};
)";
  check_refused(
      run_flexneck("mesh -q --set geometry.script=" + (folder / "apart.geo").string() +
                   " --set 'geometry.constants={}' " + kExamples + "cantilever.toml" + out),
      "nodes coincide with others");
  check_refused(run_flexneck("mesh -q --set geometry.unit=kg " + study), "geometry.unit");
  check_refused(run_flexneck("mesh -q --set geometry.file=cantilever.stl " + study),
                "expected a file with one of the extensions");
  check_refused(run_flexneck("mesh -q --set geometry.file=part.step " + study),
                "a STEP file contains its unit");
  check_refused(run_flexneck("mesh -q --set geometry.script=a.geo " + study),
                "expected file or script, found both");
  check_refused(run_flexneck("mesh -q --set geometry.constants.lengh='1 m' " + kExamples +
                             "cantilever.toml" + out),
                "did you mean 'length'");
}

TEST_CASE("with MUMPS the command finds the same frequencies and says what it took") {
  const TemporaryFolder folder;
  const std::string study = kExamples + "cantilever.toml";
  run_study(study, folder.path());
  const Eigen::VectorXd truth = frequencies_in(folder.path());
  const CommandOutcome outcome =
      run_flexneck("modes --solver mumps " + study + " -o " + folder.path().string());
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("MUMPS: the factor has "));
  const auto body = fe_modal::read_modal_body(folder / "modes.h5").body;
  CHECK_THAT(outcome.text, Contains(body.solver));
  CHECK(body.frequencies_Hz.isApprox(truth, 1e-9));
}
