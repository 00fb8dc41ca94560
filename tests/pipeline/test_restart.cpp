// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <catch2/catch.hpp>

#include "multibody/files/history_file.h"
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

}  // namespace flexneck::pipeline
