// SPDX-License-Identifier: GPL-3.0-or-later
// The slit neck as one deformable body with gaps, compared with plates and sections from the same
// mesh.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "fe_modal/body/gap_coordinates.h"
#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/result_table.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;

namespace {

const std::string kCoarseNeck =
    " --set mesh.quadrant=2 --set mesh.inner_ring=2 --set mesh.rubber_layers=2"
    " --set 'geometry.bolt_patch_radius=0.4 in'";

const std::string kSolver = R"([solver]
analysis = "quasi_static"
end_time = "1 s"
[output]
interval = "1 s"
[[body]]
name = "ground"
kind = "ground"
[[marker]]
body = "ground"
name = "bottom"
position = ["0 m", "0 m", "0 m"]
)";

std::string torque(const std::string& marker, double moment_Nm) {
  return "[[torque]]\nname = \"bend\"\nmarker = \"" + marker +
         "\"\ndirection = [0, 1, 0]\ntimes = [\"0 s\", \"1 s\"]\nmagnitudes = [\"0 N*m\", \"" +
         std::to_string(moment_Nm) + " N*m\"]\n";
}

std::string one_body(double moment_Nm, const std::string& more = "") {
  return kSolver + R"(
[[body]]
name = "neck"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 1
)" + more +
         R"(
[[joint]]
name = "clamp"
kind = "fixed"
lower = "ground.bottom"
upper = "neck.base"
)" + torque("neck.top", moment_Nm);
}

std::string plates(double moment_Nm) {
  std::string text = kSolver;
  std::string lower = "ground.bottom";
  std::string base = "base";
  for (int k = 1; k <= 4; ++k) {
    const std::string name = "disc_" + std::to_string(k);
    text += "[[body]]\nname = \"" + name + "\"\nkind = \"rigid\"\nlumped = true\n";
    text += "[[marker]]\nbody = \"" + name +
            "\"\nname = \"face\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n";
    text += "[[section]]\nname = \"" + name + "\"\nlower = \"" + lower + "\"\nupper = \"" + name +
            ".face\"\nmodes_file = \"substructure_" + name + ".h5\"\nbase = \"" + base +
            "\"\ntop = \"" + (k == 4 ? "top" : "to_disc_" + std::to_string(k + 1)) + "\"\n";
    lower = name + ".face";
    base = "to_" + name;
  }
  return text + torque("disc_4.face", moment_Nm);
}

/// Rotation about y of a marker at the end of a run.
double rotation(const std::filesystem::path& folder, const std::string& text,
                const std::string& marker) {
  const auto model = testing::write_test_file(folder / "bend.toml", text);
  const testing::CommandOutcome outcome =
      testing::run_flexneck("simulate " + model.string() + " -q -o " + folder.string());
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const auto history = multibody::read_history(folder / "bend.h5").history;
  const auto& at = history.marker(marker).rotation;
  return 2 * std::atan2(at(2, at.cols() - 1), at(0, at.cols() - 1));
}

/// Results of a case of a study's pendulum on a coarse mesh.
class PendulumFigures {
 public:
  explicit PendulumFigures(const std::string& study_and_options)
      : line_(study_and_options + kCoarseNeck + " -q -o " + folder_.path().string() +
              " --set 'cases=[\"certification-extension\"]'") {
    run("mesh ");
    run("modes ");
    swing(" --set 'pendulum.duration=0.1 s'");
  }

  void swing(const std::string& options) {
    run("pendulum ", options);
    tables_ = pipeline::read_tables(folder_ / "pendulum.json").tables;
  }
  std::filesystem::path modes() const { return folder_ / "modes.h5"; }

  /// Value in the first column of that name.
  double value(const std::string& table, const std::string& column) const {
    const auto named = [](const std::string& name) {
      return [name](const auto& each) { return each.name == name; };
    };
    const auto found = std::ranges::find_if(tables_, named(table));
    REQUIRE(found != tables_.end());
    const auto at = std::ranges::find_if(found->columns, named(column));
    REQUIRE(at != found->columns.end());
    return std::stod(found->rows.at(0).at(static_cast<std::size_t>(at - found->columns.begin())));
  }

 private:
  void run(const std::string& stage, const std::string& options = "") const {
    const testing::CommandOutcome outcome = testing::run_flexneck(stage + line_ + options);
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
  }

  TemporaryFolder folder_;
  std::string line_;
  std::vector<pipeline::ResultTable> tables_;
};

/// Text of an offset of modes out of the plane of the case, which moves no interface.
std::string lateral_offset(const fe_modal::ModalBody& body) {
  const fe_modal::ModalBody modes = fe_modal::with_gap_coordinates(body).modes;
  std::vector<Eigen::Index> lateral;
  for (Eigen::Index k = 0; k < modes.mode_count(); ++k) {
    const auto& shares = modes.modes[static_cast<std::size_t>(k)].shares_percent;
    if (shares[1] + shares[2] > 50) lateral.push_back(k);
  }
  const fe_modal::Interface& top = modes.interface("top");
  Eigen::MatrixXd motion(6, modes.mode_count());
  motion << top.translation, top.rotation;
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(modes.mode_count());
  offset(lateral) = 0.01 * motion(Eigen::all, lateral).fullPivLu().kernel().col(0).normalized();
  REQUIRE(offset.norm() == Approx(0.01));
  std::string list;
  for (const double each : offset) list += fmt::format("{}{}", list.empty() ? "" : ", ", each);
  return " --set 'body.slit_neck.offset=[" + list + "]'";
}

}  // namespace

TEST_CASE("a neck as one body with gaps swings in the test as plates and elastic sections do") {
  const std::string studies = pipeline::built_in_qualification().parent_path().string();
  const std::string one_body = studies + "/qualification_one_body.toml";
  PendulumFigures one(one_body);
  const PendulumFigures chain(studies +
                              "/hybrid3_qualification.toml"
                              " --set substructures.slits=openings"
                              " --set variables.relaxing_share=1e-9");
  // Gravity keeps all slits open; apart from that the single body is linear in its own frame.
  const auto ratio = [&](const char* table, const char* column) {
    return one.value(table, column) / chain.value(table, column);
  };
  CHECK(ratio("oscillations", "eigenvalue") == Approx(1).epsilon(0.01));
  CHECK(ratio("peaks", "head rotation") == Approx(1).epsilon(0.04));
  CHECK(ratio("peaks", "at") == Approx(1).epsilon(0.06));

  // Small motions in the plane leave out the other modes, with all values given for them.
  const double straight = one.value("oscillations", "eigenvalue");
  one.swing(" --set 'pendulum.duration=2 ms'" +
            lateral_offset(fe_modal::read_modal_body(one.modes()).body));
  CHECK(one.value("oscillations", "eigenvalue") == straight);
}

TEST_CASE("a slit neck as one body with gaps bends as plates and sections do, both ways") {
  const TemporaryFolder folder;
  const std::string line = " " + pipeline::built_in_qualification().string() + " -q -o " +
                           folder.path().string() + kCoarseNeck +
                           " --set substructures.slits=openings --set modes.slits=openings --set "
                           "modes.basis=residual --set modes.count=4";
  for (const char* const stage : {"mesh", "modes"}) {
    const testing::CommandOutcome outcome = testing::run_flexneck(stage + line);
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
  }
  constexpr double kSmall_Nm = 0.5;
  const double shut = rotation(folder.path(), one_body(kSmall_Nm), "neck.top");
  const double open = -rotation(folder.path(), one_body(-kSmall_Nm), "neck.top");
  CHECK(open > 1.05 * shut);
  CHECK(shut == Approx(rotation(folder.path(), plates(kSmall_Nm), "disc_4.face")).epsilon(0.005));
  CHECK(open == Approx(-rotation(folder.path(), plates(-kSmall_Nm), "disc_4.face")).epsilon(0.01));

  const auto refused = [&](const std::string& key, const char* message) {
    const auto model = testing::write_test_file(folder / "bad.toml", one_body(kSmall_Nm, key));
    const testing::CommandOutcome outcome =
        testing::run_flexneck("simulate " + model.string() + " -q -o " + folder.path().string());
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.text, Contains(message));
  };
  refused("modes = [\"shut 1\"]\n", "expected all modes");
  refused("stress_stiffening = true\n", "stress_stiffening");
}
