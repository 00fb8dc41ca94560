// SPDX-License-Identifier: GPL-3.0-or-later
// Calls that an importer may and may not make: states, null pointers, threads, unloading.
#include <array>
#include <cmath>
#include <fstream>
#include <thread>

#include "tests/pipeline/exchange/fmu/fmu_importer.h"
#include "tests/pipeline/exchange/fmu/fmu_models.h"

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
    "what an importer may not do is refused with a message, and an FMU unloads without a rest") {
  const TemporaryFolder folder;
  const std::string formulas = GENERATE(as<std::string>(), "", kFormulas);
  LoadedFmu fmu(unpacked(folder, sled_text(kPulse) + formulas));
  {
    FmuRun run(fmu);
    CHECK(run.step(0, 1e-3) == fmi3Error);
    CHECK_THAT(run.logged,
               Contains("expected an FMU instance in step mode, found it before initialization"));
    CHECK_THROWS_WITH(run.set("nod", 1), Contains("neither a parameter nor an input"));
    run.set("body.head.mass", -1);
    CHECK_THROWS_WITH(run.initialize(), Contains("body 'head'"));
    REQUIRE(run.call("fmi3Reset") == fmi3OK);
    run.initialize(1e-6);
    CHECK_THROWS_WITH(run.set("body.head.mass", 3),
                      Contains("cannot be changed after initialization"));
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
  CHECK_THROWS_WITH(FmuRun(LoadedFmu(folder / "fmu")), Contains("model.bin: expected the file"));
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
  CHECK_THROWS_WITH(other.state_of(bytes), Contains("or belongs to another model"));
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

}  // namespace flexneck::pipeline
