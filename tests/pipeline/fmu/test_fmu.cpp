// SPDX-License-Identifier: GPL-3.0-or-later
// FMUs driven by an importer: compared with simulate, saved and restored, two at once, unloaded.
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

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
const char* const kFormulas = R"toml([[function_force]]
name = "muscle"
lower = "sled.hook"
upper = "head.top"
Fx = "-200 * x * (1 + 3 * x^2) - 4 * vx"
Fy = "20 * sin(60 * t)"
My = "-3 * ry - 0.05 * wy"
)toml";
const std::vector<std::string> kOutputs = {"top.x",      "top.y",      "top.z",      "nod",
                                           "condyles.x", "condyles.y", "energy.work"};

/// A block of 2 kg on a rail along x.
std::string block_text(const std::string& analysis, const std::string& more) {
  return R"(
[solver]
end_time = "1 s"
analysis = ")" +
         analysis + R"("
[output]
interval = "0.1 s"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "block"
kind = "rigid"
mass = "2 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1e-3 kg*m^2", "1e-3 kg*m^2", "1e-3 kg*m^2"]
[[marker]]
body = "ground"
name = "rail"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "center"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "slide"
kind = "prismatic"
lower = "ground.rail"
upper = "block.center"
axis = [1, 0, 0]
[[channel]]
name = "place"
quantity = "position"
marker = "block.center"
[[channel]]
name = "rail"
quantity = "force"
joint = "slide"
[[channel]]
name = "energy"
quantity = "energy"
)" + more;
}

/// The FMU of a model in the folder, unpacked.
std::filesystem::path unpacked(const TemporaryFolder& folder, const std::string& text) {
  testing::write_beam_modes(folder / "neck.h5");
  testing::write_test_file(folder / "sled.toml", text);
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

TEST_CASE(
    "what an importer may not do is refused with a message, and an FMU unloads without a rest") {
  const TemporaryFolder folder;
  const std::string formulas = GENERATE(as<std::string>(), "", kFormulas);
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse) + formulas));
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
  // Change one bit of the model in the FMU's folder.
  const std::filesystem::path model = folder / "fmu/resources/model.bin";
  std::fstream file(model, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(1000);
  const int byte = file.get();
  file.seekp(1000);
  file.put(static_cast<char>(byte ^ 1));
  file.close();
  CHECK_THROWS_WITH(FmuRun(LoadedFmu(folder / "fmu")), Contains("model.bin: expected the bytes"));
}

TEST_CASE("null arrays, and saved states that are damaged or of another model, are refused") {
  const TemporaryFolder folder, other_folder;
  LoadedFmu fmu(unpacked(folder, block_text("motion", "")));
  FmuRun run(fmu);
  run.initialize();
  const fmi3ValueReference reference = fmu.reference("place.x");
  double value = 0;
  std::size_t size = 0;
  fmi3FMUState state = run.save();
  const std::vector<fmi3Byte> bytes = run.bytes_of(state);
  const auto get = fmu.function<fmi3GetFloat64TYPE>("fmi3GetFloat64");
  const auto set = fmu.function<fmi3SetFloat64TYPE>("fmi3SetFloat64");
  const auto to_bytes = fmu.function<fmi3SerializeFMUStateTYPE>("fmi3SerializeFMUState");
  const auto from_bytes = fmu.function<fmi3DeserializeFMUStateTYPE>("fmi3DeserializeFMUState");
  const auto size_of = fmu.function<fmi3SerializedFMUStateSizeTYPE>("fmi3SerializedFMUStateSize");
  void* const at = run.instance();
  CHECK(get(at, nullptr, 1, &value, 1) == fmi3Error);
  CHECK(get(at, &reference, 1, nullptr, 1) == fmi3Error);
  CHECK(get(at, nullptr, 0, nullptr, 0) == fmi3OK);
  CHECK(set(at, nullptr, 1, &value, 1) == fmi3Error);
  CHECK(set(at, &reference, 1, nullptr, 1) == fmi3Error);
  CHECK(size_of(at, state, nullptr) == fmi3Error);
  CHECK(size_of(at, nullptr, &size) == fmi3Error);
  CHECK(to_bytes(at, state, nullptr, bytes.size()) == fmi3Error);
  CHECK(from_bytes(at, nullptr, bytes.size(), &state) == fmi3Error);
  CHECK(from_bytes(at, bytes.data(), bytes.size(), nullptr) == fmi3Error);
  CHECK(fmu.function<fmi3GetFMUStateTYPE>("fmi3GetFMUState")(at, nullptr) == fmi3Error);
  CHECK(fmu.function<fmi3SetFMUStateTYPE>("fmi3SetFMUState")(at, nullptr) == fmi3Error);
  CHECK_THAT(run.logged, Contains("found a null pointer"));
  for (std::size_t place = 0; place < bytes.size(); ++place) {
    std::vector<fmi3Byte> damaged = bytes;
    damaged[place] = static_cast<fmi3Byte>(damaged[place] ^ (1U << place % 8));
    CHECK_THROWS_WITH(run.state_of(damaged), Contains("the saved state is damaged"));
  }
  for (const std::size_t length : {std::size_t{0}, bytes.size() / 2, bytes.size() - 1})
    CHECK_THROWS(run.state_of({bytes.begin(), bytes.begin() + static_cast<long>(length)}));
  std::vector<fmi3Byte> longer = bytes;
  longer.push_back(0);
  CHECK_THROWS(run.state_of(longer));
  LoadedFmu other_fmu(unpacked(other_folder, block_text("motion", R"([[channel]]
name = "speed"
quantity = "velocity"
marker = "block.center"
)")));
  FmuRun other(other_fmu);
  other.initialize();
  CHECK_THROWS_WITH(other.state_of(bytes), Contains("or one of another model"));
  fmi3FMUState same = run.state_of(bytes);
  CHECK(run.bytes_of(same) == bytes);
  run.free(same);
  run.free(state);
}

TEST_CASE("an importer ends a long step where it wants, and goes on from there") {
  const TemporaryFolder folder;
  // 2 kg on 200 N/m, displaced by 0.1 m: its position is 0.1 m (cos(10 t) - 1).
  LoadedFmu fmu(unpacked(folder, block_text("motion", R"([[marker]]
body = "ground"
name = "hook"
position = ["-1 m", "0 m", "0 m"]
[[spring]]
name = "coil"
lower = "ground.hook"
upper = "block.center"
free_length = "0.9 m"
stiffness = "200 N/m"
)")));
  FmuRun run(fmu);
  run.initialize(1e-10);
  const auto expected = [](double time_s) { return 0.1 * (std::cos(10 * time_s) - 1); };
  int asked = 0;
  run.goes_on = [&](double time_s) { return ++asked > 0 && time_s < 3.3; };
  REQUIRE(run.step(0, 2000) == fmi3OK);
  CHECK(asked > 10);
  CHECK(run.reached_s >= 3.3);
  CHECK(run.reached_s < 3.5);
  CHECK(run.get("place.x") == Approx(expected(run.reached_s)).margin(1e-6));
  run.goes_on = {};
  REQUIRE(run.step(run.reached_s, 5 - run.reached_s) == fmi3OK);
  CHECK(run.get("place.x") == Approx(expected(5)).margin(1e-6));
}

TEST_CASE("eight instances on eight threads have the outputs of one") {
  const std::string formulas = GENERATE(as<std::string>(), "", kFormulas);
  const TemporaryFolder folder;
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse) + formulas));
  constexpr int kSteps = 200;
  const auto outputs = [&] {
    FmuRun run(fmu);
    run.initialize();
    std::vector<std::vector<double>> found = {run.get(kOutputs)};
    for (int k = 0; k < kSteps; ++k) {
      if (run.step(k * 5e-4, (k + 1) * 5e-4 - k * 5e-4) != fmi3OK) break;
      found.push_back(run.get(kOutputs));
    }
    return found;
  };
  const auto alone = outputs();
  REQUIRE(alone.size() == kSteps + 1);
  std::array<std::vector<std::vector<double>>, 8> together;
  {
    std::vector<std::jthread> threads;
    for (auto& each : together) threads.emplace_back([&] { each = outputs(); });
  }
  for (const auto& each : together) CHECK(each == alone);
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
