// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "multibody/files/history_file.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_reading.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;

namespace flexneck::pipeline {

using multibody::History;
using testing::read_model;
using testing::refusal_of_model;
using testing::run;

TEST_CASE("a run goes on from an output of another as that one does") {
  const TemporaryFolder folder;
  testing::write_beam_modes(folder / "neck.h5");
  const std::string text = R"toml(
[solver]
end_time = "0.1 s"
relative_tolerance = 1e-11
absolute_tolerance = 1e-14
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[output]
interval = "10 ms"
[[body]]
name = "ground"
kind = "prescribed"
displacement = "0.01 * sin(60 * t)"
[[joint]]
name = "foot"
kind = "revolute"
lower = "ground.foot"
upper = "neck.base"
axis = [1, 2, 0]
rate = "4 rad/s"
[[joint]]
name = "condyles"
kind = "spherical"
lower = "neck.top"
upper = "head.joint"
)toml" + testing::neck_and_head_text() +
                           testing::origin_marker_text("ground", "foot") +
                           testing::origin_marker_text("head", "joint");
  const std::string section = R"([[section]]
name = "band"
lower = "neck.top"
upper = "head.joint"
length = ["0 m", "0 m", "0 m"]
translation_stiffness = ["0 N/m", "0 N/m", "0 N/m"]
rotation_stiffness = ["90 N*m/rad", "80 N*m/rad", "70 N*m/rad"]
relaxation_times = ["20 ms"]
relaxation_shares = [0.5]
)";
  for (const std::string formulation : {"recursive", "descriptor"}) {
    INFO(formulation);
    std::string chosen = text + section;
    chosen.insert(chosen.find("[output]"), "formulation = \"" + formulation + "\"\n");
    const ModelFile whole = read_model(folder, chosen);
    const History truth = run(whole, true);
    multibody::HistoryFile kept;
    kept.history = truth;
    multibody::write_history(folder / "whole.h5", kept);
    const std::string restarted = chosen + "[restart]\nfile = \"whole.h5\"\ntime = \"40 ms\"\n";
    const ModelFile file = read_model(folder, restarted);
    const History found = run(file);
    REQUIRE(found.time_s.size() == 7);
    CHECK(found.time_s[0] == Approx(0.04));
    const auto difference = [&](const auto& a, const auto& b) {
      return (a - b.rightCols(7)).cwiseAbs().maxCoeff();
    };
    CHECK(difference(found.marker("head.joint").position_m, truth.marker("head.joint").position_m) <
          1e-10);
    CHECK(difference(found.marker("head.joint").velocity_m_s,
                     truth.marker("head.joint").velocity_m_s) < 1e-8);
    CHECK(difference(found.modal[0].coordinates, truth.modal[0].coordinates) < 1e-10);
    CHECK((found.energy.dissipated_J - truth.energy.dissipated_J.tail(7)).cwiseAbs().maxCoeff() <
          1e-9);
    CHECK((found.energy.work_J - truth.energy.work_J.tail(7)).cwiseAbs().maxCoeff() < 1e-9);
    CHECK_THAT(
        refusal_of_model(folder, chosen + "[restart]\nfile = \"whole.h5\"\ntime = \"45 ms\"\n"),
        Contains("restart.time: the history has no output at 0.045 s; the nearest is at 0.0"));
    std::string at_rest = chosen;
    at_rest.erase(at_rest.find("rate = "), std::string("rate = \"4 rad/s\"").size());
    at_rest.insert(at_rest.find("damping_ratio"), "modal_coordinates = [1e-3, 0, 0, 0]\n");
    at_rest.insert(at_rest.find("end_time"), "start = \"equilibrium\"\n");
    CHECK_THAT(refusal_of_model(folder, at_rest),
               Contains("body 'neck': modal_coordinates are given, but [solver] has start"));
    kept.history.state = {};
    multibody::write_history(folder / "whole.h5", kept);
    CHECK_THAT(refusal_of_model(folder, restarted), Contains("the history has no states"));
  }
}

namespace {

/// A wheel of 0.5 kg m^2 with a coil spring of 2 N m/rad.
std::string coil_text(const std::string& formulation, const std::string& joint) {
  return R"toml([solver]
end_time = "3 s"
relative_tolerance = 1e-10
absolute_tolerance = 1e-13
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
formulation = ")toml" +
         formulation + R"toml("
[output]
interval = "0.5 s"
states = true
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "wheel"
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["0.5 kg*m^2", "0.5 kg*m^2", "0.5 kg*m^2"]
)toml" + testing::origin_marker_text("ground", "hub") +
         testing::origin_marker_text("wheel", "hub") + R"toml([[joint]]
name = "hub"
kind = "revolute"
lower = "ground.hub"
upper = "wheel.hub"
axis = [0, 0, 1]
)toml" + joint +
         R"toml(
[[resistance]]
name = "coil"
joint = "hub"
coordinate = "angle"
stiffness = "2 N*m/rad"
[[channel]]
name = "turn"
quantity = "angle"
marker = "wheel.hub"
axis = [0, 0, 1]
)toml";
}

}  // namespace

TEST_CASE("a restart keeps the turns of a wound spring, and tells that masses have changed") {
  const TemporaryFolder folder;
  const std::string formulation = GENERATE(as<std::string>(), "recursive", "descriptor");
  const std::string text = coil_text(formulation, "rate = \"40 rad/s\"");
  const auto run_into = [&](const std::string& name, const std::string& model) {
    testing::write_test_file(folder / (name + ".toml"), model);
    const auto outcome = testing::run_flexneck("simulate -q " + (folder / name).string() +
                                               ".toml -o " + folder.path().string());
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
    return std::pair(multibody::read_history(folder / (name + ".h5")), outcome.text);
  };
  run_into("whole", text);
  // The run resumes at 0.5 s, after 2.7 turns.
  const std::string restart = "[restart]\nfile = \"whole.h5\"\ntime = \"0.5 s\"\n";
  const auto [rest, said] = run_into("rest", restart + text);
  CHECK(said.empty());
  for (Eigen::Index k = 0; k < rest.history.time_s.size(); ++k) {
    const double angle = 20 * std::sin(2 * rest.history.time_s[k]);
    CHECK(rest.channels[0].values(0, k) == Approx(angle).margin(1e-6));
    CHECK(rest.history.energy.strain_J[k] == Approx(angle * angle).margin(1e-4));
  }
  std::string heavier = restart + text;
  heavier.replace(heavier.find("1 kg"), 4, "3 kg");
  CHECK_THAT(run_into("heavier", heavier).second,
             Contains("body 'wheel' has a different mass in this model (3 kg)"));
}

TEST_CASE("a joint starts at an angle of any turn, a body's rotation has none") {
  const TemporaryFolder folder;
  const std::string formulation = GENERATE(as<std::string>(), "recursive", "descriptor");
  const double start = GENERATE(-1100., 400., 75.);  // deg
  const ModelFile file =
      read_model(folder, coil_text(formulation, "angle = \"" + std::to_string(start) + " deg\""));
  const History history = run(file);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double angle = start * std::numbers::pi / 180 * std::cos(2 * history.time_s[k]);
    CHECK(history.angles[0].angle_rad[k] == Approx(angle).margin(1e-6));
    CHECK(history.energy.strain_J[k] == Approx(angle * angle).margin(1e-4));
  }
  std::string turned = coil_text(formulation, "");
  turned.insert(turned.find("mass ="), "rotation = [\"0 deg\", \"0 deg\", \"400 deg\"]\n");
  CHECK_THAT(refusal_of_model(folder, turned), Contains("found a length of 6.98132 rad"));
}

}  // namespace flexneck::pipeline
