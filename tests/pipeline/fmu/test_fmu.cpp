// SPDX-License-Identifier: GPL-3.0-or-later
// FMUs as an importer drives them: beside simulate, saved and restored, two at once, unloaded.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/pipeline/fmu/fmu_importer.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_reading.h"

using Catch::Matchers::Contains;

namespace flexneck::pipeline {
namespace {

using testing::FmuRun;
using testing::LoadedFmu;

/// A head on a neck on a sled, with a pulse, a push, and a strap that goes slack.
std::string sled_text(const std::string& acceleration) {
  return R"(
[solver]
end_time = "0.1 s"
relative_tolerance = 1e-9
absolute_tolerance = 1e-12
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
start = "equilibrium"
[output]
interval = "1 ms"
[[body]]
name = "sled"
kind = "prescribed"
)" + acceleration +
         testing::neck_and_head_text() +
         R"([[marker]]
body = "sled"
name = "seat"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "sled"
name = "hook"
position = ["-0.2 m", "0 m", "0.2 m"]
[[marker]]
body = "head"
name = "joint"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "head"
name = "top"
position = ["0 m", "0 m", "0.1 m"]
[[joint]]
name = "seat"
kind = "fixed"
lower = "sled.seat"
upper = "neck.base"
[[joint]]
name = "condyles"
kind = "fixed"
lower = "neck.top"
upper = "head.joint"
[[spring]]
name = "strap"
lower = "sled.hook"
upper = "head.top"
free_length = "0.22 m"
stiffness = "3000 N/m"
tension_only = true
damping = "5 N*s/m"
[[force]]
name = "push"
marker = "head.top"
direction = [0, 1, 0]
times = ["0 ms", "20 ms", "30 ms"]
magnitudes = ["0 N", "60 N", "0 N"]
[[channel]]
name = "top"
quantity = "position"
marker = "head.top"
[[channel]]
name = "nod"
quantity = "angle"
marker = "head.top"
axis = [0, 1, 0]
[[channel]]
name = "condyles"
quantity = "moment"
joint = "condyles"
[[channel]]
name = "energy"
quantity = "energy"
)";
}

const char* const kPulse =
    "acceleration = \"-150 * sin(pi * t / 0.06) * (t < 0.06)\"\ninitial_velocity = \"5 m/s\"";
const std::vector<std::string> kOutputs = {"top.x",      "top.y",      "top.z",      "nod",
                                           "condyles.x", "condyles.y", "energy.work"};

/// The FMU of a model in the folder, unpacked.
std::filesystem::path unpacked(const TemporaryFolder& folder, const std::string& text) {
  testing::write_beam_modes(folder / "neck.h5");
  testing::write_text(folder / "sled.toml", text);
  const std::string at = folder.path().string();
  const auto outcome =
      testing::run_flexneck("export -q " + at + "/sled.toml --to " + at + "/sled.fmu");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  REQUIRE(testing::run_shell("unzip -q -o " + at + "/sled.fmu -d " + at + "/fmu").exit_code == 0);
  return folder / "fmu";
}

}  // namespace

TEST_CASE(
    "an FMU in 1000 steps has the outputs of simulate, and the same again from saved states") {
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse)));
  CHECK(fmu.function<fmi3GetVersionTYPE>("fmi3GetVersion")() == std::string("3.0"));
  // simulate with its outputs where the steps end.
  const std::string fine = " --set output.interval='0.1 ms' --set solver.relative_tolerance=1e-10";
  const std::string at = folder.path().string();
  REQUIRE(testing::run_flexneck("simulate -q " + at + "/sled.toml -o " + at + fine).exit_code == 0);
  const multibody::HistoryFile truth = multibody::read_history(folder / "sled.h5");
  const auto channel = [&](std::size_t index) -> const Eigen::MatrixXd& {
    return truth.channels[index].values;
  };

  FmuRun run(fmu);
  FmuRun other(fmu);  // another instance in between, with another mass
  other.set("body.head.mass", 2);
  run.initialize(1e-10);
  other.initialize();
  fmi3FMUState middle = nullptr;
  std::vector<std::vector<double>> found;
  double largest_m = 0, largest_rad = 0, largest_Nm = 0;
  constexpr int kSteps = 1000;
  for (int k = 0; k <= kSteps; ++k) {
    found.push_back(run.get(kOutputs));
    const std::vector<double>& now = found.back();
    for (int axis = 0; axis < 3; ++axis)
      largest_m =
          std::max(largest_m, std::abs(now[static_cast<std::size_t>(axis)] - channel(0)(axis, k)));
    largest_rad = std::max(largest_rad, std::abs(now[3] - channel(1)(0, k)));
    for (int axis = 0; axis < 2; ++axis)
      largest_Nm = std::max(
          largest_Nm, std::abs(now[4 + static_cast<std::size_t>(axis)] - channel(2)(axis, k)));
    if (k == kSteps / 2) middle = run.save();
    if (k == kSteps) break;
    REQUIRE(run.step(k * 1e-4, (k + 1) * 1e-4 - k * 1e-4) == fmi3OK);
    if (k % 10 == 0) REQUIRE(other.step(k * 1e-4, 1e-3) == fmi3OK);
  }
  INFO("largest differences from simulate: " << largest_m << " m, " << largest_rad << " rad, "
                                             << largest_Nm << " N m");
  CHECK(largest_m < 1e-8);
  CHECK(largest_rad < 1e-7);
  CHECK(largest_Nm < 1e-5 * channel(2).cwiseAbs().maxCoeff());
  CHECK(std::abs(other.get("nod") - found.back()[3]) > 1e-3);

  // From the middle again, in this instance and, by bytes, in a new one, whose mode and tolerance
  // are part of the state.
  const std::vector<fmi3Byte> bytes = run.bytes_of(middle);
  FmuRun third(fmu);
  fmi3FMUState copy = third.state_of(bytes);
  third.restore(copy);
  third.free(copy);
  run.restore(middle);
  run.free(middle);
  CHECK(middle == nullptr);
  for (int k = kSteps / 2; k < kSteps; ++k) {
    REQUIRE(run.step(k * 1e-4, (k + 1) * 1e-4 - k * 1e-4) == fmi3OK);
    REQUIRE(third.step(k * 1e-4, (k + 1) * 1e-4 - k * 1e-4) == fmi3OK);
    REQUIRE(run.get(kOutputs) == found[static_cast<std::size_t>(k) + 1]);
    REQUIRE(third.get(kOutputs) == found[static_cast<std::size_t>(k) + 1]);
  }
}

TEST_CASE("inputs of an FMU add to the model's own: a constant acceleration and load") {
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, sled_text("initial_velocity = \"5 m/s\"")));
  FmuRun run(fmu);
  run.set("force.push.magnitude", 10);
  run.initialize();
  const ModelFile own = testing::read_model(
      folder, sled_text("initial_velocity = \"5 m/s\"\nacceleration = \"-80 * (t >= 0.03)\""));
  multibody::Model model = own.model;
  model.forces.of<multibody::PointForce>()[0].input_N = 10;
  const multibody::History truth = multibody::simulate_from_equilibrium(
      model, own.solver, {.end_time_s = 0.1, .interval_s = 0.01});
  for (int k = 0; k < 10; ++k) {
    if (k == 3) run.set("body.sled.acceleration", -80);
    REQUIRE(run.step(k * 0.01, (k + 1) * 0.01 - k * 0.01) == fmi3OK);
    const Eigen::Vector3d expected = truth.marker("head.top").position_m.col(k + 1);
    const std::vector<double> top = run.get({"top.x", "top.y", "top.z"});
    CHECK((Eigen::Vector3d(top[0], top[1], top[2]) - expected).norm() < 1e-7);
  }
  CHECK(run.get("body.sled.acceleration") == -80);
}

TEST_CASE(
    "what an importer may not do is refused with a message, and an FMU unloads without a rest") {
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse)));
  {
    FmuRun run(fmu);
    CHECK(run.step(0, 1e-3) == fmi3Error);
    CHECK_THAT(run.logged,
               Contains("expected an instance in step mode, found one before initialization"));
    CHECK_THROWS_WITH(run.set("nod", 1), Contains("neither a parameter nor an input"));
    run.set("body.head.mass", -1);
    CHECK_THROWS_WITH(run.initialize(), Contains("body 'head'"));
    REQUIRE(run.call("fmi3Reset") == fmi3OK);
    run.initialize(1e-6);
    CHECK_THROWS_WITH(run.set("body.head.mass", 3), Contains("stays after initialization"));
    CHECK(run.step(0.5, 1e-3) == fmi3Error);
    CHECK(run.step(0, -1) == fmi3Error);
    CHECK(run.call("fmi3EnterEventMode") == fmi3Error);
    CHECK(run.step(0, 1e-3) == fmi3OK);
    CHECK(run.call("fmi3Terminate") == fmi3OK);
  }
  CHECK(fmu.close());
  // One bit of the model in the FMU's folder.
  const std::filesystem::path model = folder / "fmu/resources/model.bin";
  std::fstream file(model, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(1000);
  const int byte = file.get();
  file.seekp(1000);
  file.put(static_cast<char>(byte ^ 1));
  file.close();
  CHECK_THROWS_WITH(FmuRun(LoadedFmu(folder / "fmu")), Contains("model.bin: expected the bytes"));
}

}  // namespace flexneck::pipeline
