// SPDX-License-Identifier: GPL-3.0-or-later
// FMUs driven by an importer: compared with simulate and closed forms.
#include <cmath>
#include <cstdlib>

#include "tests/pipeline/exchange/fmu/fmu_importer.h"
#include "tests/pipeline/exchange/fmu/fmu_models.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_reading.h"

using Catch::Matchers::Contains;

namespace flexneck::pipeline {

using testing::block_text;
using testing::FmuRun;
using testing::kFormulas;
using testing::kOutputs;
using testing::kPulse;
using testing::LoadedFmu;
using testing::sled_text;
using testing::unpacked;

TEST_CASE(
    "an FMU in 1000 steps has the outputs of simulate, and the same again from saved states") {
  // There are two shared objects, without and with muParser.
  const std::string formulas = GENERATE(as<std::string>(), "", kFormulas);
  CAPTURE(formulas);
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse) + formulas));
  CHECK(fmu.function<fmi3GetVersionTYPE>("fmi3GetVersion")() == std::string("3.0"));
  // Run simulate with outputs at the ends of the steps.
  const std::string fine = " --set output.interval='0.1 ms' --set solver.relative_tolerance=1e-10";
  const std::string at = folder.path().string();
  REQUIRE(testing::run_flexneck("simulate -q " + at + "/sled.toml -o " + at + fine).exit_code == 0);
  const multibody::HistoryFile truth = multibody::read_history(folder / "sled.h5");
  const auto channel = [&](std::size_t index) -> const Eigen::MatrixXd& {
    return truth.channels[index].values;
  };

  FmuRun run(fmu);
  FmuRun other(fmu);  // another instance meanwhile, with another mass
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

  // Resume from the middle, in this instance and, by serialised bytes, in a new one; mode and
  // tolerance are part of the state.
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

TEST_CASE("an input of a motor adds to its motion, with what its joint bears") {
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, block_text("motion", R"([[motor]]
name = "drive"
joint = "slide"
coordinate = "distance"
initial_speed = "0.5 m/s"
)")));
  FmuRun run(fmu);
  run.initialize();
  REQUIRE(run.step(0, 0.2) == fmi3OK);
  run.set("joint.slide.acceleration", 3);
  CHECK(run.get("rail.x") == Approx(6).epsilon(1e-12));  // 2 kg
  REQUIRE(run.step(0.2, 0.8) == fmi3OK);
  CHECK(run.get("place.x") == Approx(0.5 + 0.5 * 3 * 0.64).epsilon(1e-9));
}

TEST_CASE("an FMU of a quasi-static model has the equilibria under its inputs") {
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, block_text("quasi_static", R"([[resistance]]
name = "spring"
joint = "slide"
coordinate = "distance"
stiffness = "400 N/m"
cubic = "9000 N/m^3"
[[force]]
name = "push"
marker = "block.center"
direction = [1, 0, 0]
times = ["0 s", "1 s"]
magnitudes = ["4 N", "44 N"]
)")));
  FmuRun run(fmu);
  run.initialize();
  const auto check = [](const FmuRun& of, double load_N) {
    const double x = of.get("place.x");
    CHECK(400 * x + 9000 * x * x * x == Approx(load_N).epsilon(1e-9));
    const double first = of.get("energy.strain") - of.get("energy.work");
    const double x0 = 0.00997765052;  // 400 x0 + 9000 x0^3 = 4
    CHECK(first == Approx(200 * x0 * x0 + 2250 * std::pow(x0, 4)).epsilon(1e-8));
  };
  check(run, 4);
  REQUIRE(run.step(0, 0.5) == fmi3OK);
  check(run, 24);
  run.set("force.push.magnitude", 20);
  check(run, 44);
  fmi3FMUState state = run.save();
  REQUIRE(run.step(0.5, 0.5) == fmi3OK);
  check(run, 64);
  // Repeat the end of the run, here and in a new instance.
  const std::vector<std::string> read = {"place.x", "energy.work"};
  const std::vector<double> end = run.get(read);
  FmuRun other(fmu);
  fmi3FMUState copy = other.state_of(run.bytes_of(state));
  other.restore(copy);
  other.free(copy);
  run.restore(state);
  run.free(state);
  check(other, 44);
  for (FmuRun* each : {&run, &other}) {
    REQUIRE(each->step(0.5, 0.5) == fmi3OK);
    CHECK(each->get(read) == end);
  }
}

TEST_CASE("an FMU counts turns within its steps") {
  const TemporaryFolder folder;
  const std::string spin = R"([[body]]
name = "wheel"
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1 kg*m^2", "1 kg*m^2", "1 kg*m^2"]
[[marker]]
body = "wheel"
name = "hub"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "hub"
kind = "revolute"
lower = "ground.rail"
upper = "wheel.hub"
axis = [0, 0, 1]
rate = "330 rad/s"
[[channel]]
name = "turn"
quantity = "angle"
marker = "wheel.hub"
axis = [0, 0, 1]
)";
  LoadedFmu fmu(unpacked(folder, block_text("motion", spin)));
  FmuRun run(fmu);
  run.initialize();
  REQUIRE(run.step(0, 0.5) == fmi3OK);
  CHECK(run.get("turn") == Approx(165).margin(1e-6));
  fmi3FMUState state = run.save();
  REQUIRE(run.step(0.5, 0.3) == fmi3OK);
  const double end = run.get("turn");
  CHECK(end == Approx(264).margin(1e-6));
  run.restore(state);
  run.free(state);
  REQUIRE(run.step(0.5, 0.3) == fmi3OK);
  CHECK(run.get("turn") == end);
}

}  // namespace flexneck::pipeline
