// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/cli/structure_runs.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::check_refused;
using testing::kExamples;
using testing::run_flexneck;

namespace {

/// Writes the clamped bar of the examples with additions to its study.
std::string study_with(const TemporaryFolder& folder, const std::string& modes,
                       const std::string& more = {}) {
  const std::filesystem::path path = folder / "study.toml";
  std::ofstream(path) << "include = [\"" << kExamples << "cantilever.toml\"]\n[modes]\n"
                      << modes << more;
  return path.string() + " -o " + folder.path().string();
}

fe_modal::ModalBody modes_of(const TemporaryFolder& folder, const std::string& modes,
                             const std::string& more = {}) {
  const testing::CommandOutcome outcome =
      run_flexneck("modes -q " + study_with(folder, modes, more));
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  return fe_modal::read_modal_body(folder / "modes.h5").body;
}

}  // namespace

TEST_CASE("a point mass at a coupling is a body attached to a rigid interface") {
  const TemporaryFolder folder;
  REQUIRE(run_flexneck("mesh -q " + study_with(folder, "")).exit_code == 0);
  const fe_modal::ModalBody attached =
      modes_of(folder, "rigid_interfaces = [\"tip\"]\nattached_body = \"tool\"\n",
               "[[body]]\nname = \"tool\"\nkind = \"rigid\"\nmass = \"0.3 kg\"\n"
               "center = [\"20 mm\", \"5 mm\", \"0 mm\"]\n"
               "inertia = [\"1 kg*cm^2\", \"2 kg*cm^2\", \"1.5 kg*cm^2\", \"0.1 kg*cm^2\", "
               "\"0 kg*cm^2\", \"0 kg*cm^2\"]\n");
  const fe_modal::ModalBody loaded =
      modes_of(folder,
               "[[modes.coupling]]\nname = \"tip\"\nposition = [\"0.5 m\", \"0 m\", \"0 m\"]\n"
               "[[modes.point_mass]]\nname = \"tool\"\nat = \"tip\"\nmass = \"0.3 kg\"\n"
               "center = [\"20 mm\", \"5 mm\", \"0 mm\"]\n"
               "inertia = [\"1 kg*cm^2\", \"2 kg*cm^2\", \"1.5 kg*cm^2\", \"0.1 kg*cm^2\", "
               "\"0 kg*cm^2\", \"0 kg*cm^2\"]\n");
  REQUIRE(attached.attached.size() == 1);
  const Eigen::VectorXd& expected = attached.attached[0].frequencies_Hz;
  const Eigen::VectorXd found = loaded.frequencies_Hz.head(expected.size());
  CAPTURE(expected.transpose(), found.transpose());
  CHECK((found.array() / expected.array() - 1).abs().maxCoeff() < 1e-7);
  CHECK(loaded.invariants.mass == Approx(0.81 + 0.3).epsilon(1e-9));
}

TEST_CASE("of a bar on a spring and a pin the boundary tells what is left") {
  const TemporaryFolder folder;
  REQUIRE(run_flexneck("mesh -q " + study_with(folder, "")).exit_code == 0);
  // A pin on its axis removes three translations and the rotation about the bar; a torsional spring
  // resists one of the two other rotations.
  const std::string pin =
      "fixed = []\n[[modes.coupling]]\nname = \"hub\"\nset = \"clamp\"\n"
      "position = [\"0 m\", \"0 m\", \"0 m\"]\n"
      "[[modes.support]]\nat = \"hub\"\ndirections = \"xyz\"\nturns = \"x\"\n";
  const std::string spring =
      "[[modes.spring]]\nname = \"hinge\"\nbetween = [\"hub\"]\ndirection = [0, 1, 0]\n"
      "torsional_stiffness = \"2 N*m/rad\"\n";
  const fe_modal::ModalBody body = modes_of(folder, pin + spring);
  CHECK(body.boundary == "fixed: support of 'hub'; rotates about z");
  CHECK(body.frequencies_Hz[0] == 0);
  // A rigid bar on the spring: sqrt(k / (m L^2 / 3)), much more flexible than the bar's bending.
  const double single_Hz = std::sqrt(2 / (0.81 * 0.25 / 3)) / (2 * 3.14159265358979);
  CHECK(body.frequencies_Hz[1] == Approx(single_Hz).epsilon(5e-3));
}

TEST_CASE("connections of a study that cannot be are refused in one line") {
  const TemporaryFolder folder;
  REQUIRE(run_flexneck("mesh -q " + study_with(folder, "")).exit_code == 0);
  const auto refused = [&](const std::string& modes, const std::string& text) {
    check_refused(run_flexneck("modes " + study_with(folder, modes)), text);
  };
  refused("[[modes.support]]\nat = \"tip\"\ndirection = [0, 0, 0]\n",
          "expected a direction, found a zero vector");
  refused("[[modes.support]]\nat = \"tap\"\ndirections = \"x\"\n", "did you mean 'tip'");
  refused("[[modes.support]]\nat = \"tip\"\n", "expected one of directions, direction and turns");
  refused("[[modes.spring]]\nname = \"s\"\nbetween = [\"tip\"]\nstiffness = \"1 N/m\"\n",
          "expected the direction of a spring to ground");
  refused("[[modes.point_mass]]\nname = \"m\"\nat = \"tip\"\nmass = \"1 kg\"\n",
          "expected one; define a coupling for it");
  refused(
      "[[modes.equation]]\nname = \"e\"\n[[modes.equation.term]]\nat = \"tip\"\n"
      "direction = [1, 0, 0]\n",
      "expected at least two terms, found 1");
  refused(
      "[[modes.coupling]]\nname = \"tip\"\nposition = [\"0.5 m\", \"0 m\", \"0 m\"]\n"
      "[[modes.coupling]]\nname = \"again\"\nset = \"tip\"\n"
      "position = [\"0.4 m\", \"0 m\", \"0 m\"]\n",
      "coupling 'again' and coupling 'tip' contradict each other: both determine x");
}
