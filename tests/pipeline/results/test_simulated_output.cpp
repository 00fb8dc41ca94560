// SPDX-License-Identifier: GPL-3.0-or-later

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/results/tables/simulated_output.h"
#include "tests/support/files.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::History;
using multibody::HistoryFile;
using testing::bytes_of;
using testing::double_pendulum_text;

namespace {

namespace fs = std::filesystem;

/// The arm rotates fully: its angle passes half a turn, where a block of outputs may end.
constexpr const char* kChannels = R"(
[[channel]]
name = "turned"
quantity = "angle"
marker = "upper.end"
axis = [0, 1, 0]

[[channel]]
name = "pose"
quantity = "quaternion"
marker = "lower.tip"
relative_to = "upper.end"
)";

constexpr const char* kFiltered = R"(
[[channel]]
name = "felt"
quantity = "accelerometer"
marker = "lower.tip"
filter = "CFC 60"
)";

ModelFile model_in(const TemporaryFolder& folder, const std::string& channels) {
  const std::string fast =
      testing::with(double_pendulum_text(), "rate = \"300 deg/s\"", "rate = \"40 rad/s\"");
  return read_model_file(testing::write_test_file(folder / "swing.toml", fast + channels), {});
}

/// Runs a model with outputs in blocks.
void write(const ModelFile& model, const fs::path& stem, Eigen::Index block) {
  multibody::OutputOptions options{model.end_time_s, model.output.interval_s};
  SimulatedOutput output(model, fs::path(stem).concat(".h5"), fs::path(stem).concat(".csv"), 201);
  options.sink = [&](const History& outputs) { output.append(outputs); };
  options.block = block;
  const History last = multibody::simulate(model.model, model.solver, options);
  output.finish(last, {});
  CHECK_THAT(output.peaks().text(), Contains("largest"));
}

void check_same(const HistoryFile& a, const HistoryFile& b) {
  CHECK(a.history.time_s == b.history.time_s);
  CHECK(a.history.energy.work_J == b.history.energy.work_J);
  CHECK(a.history.constraints.velocity_m_s == b.history.constraints.velocity_m_s);
  REQUIRE(a.history.markers.size() == b.history.markers.size());
  for (std::size_t k = 0; k < a.history.markers.size(); ++k) {
    CHECK(a.history.markers[k].name == b.history.markers[k].name);
    CHECK(a.history.markers[k].acceleration_m_s2 == b.history.markers[k].acceleration_m_s2);
    CHECK(a.history.markers[k].rotation == b.history.markers[k].rotation);
  }
  REQUIRE(a.history.joints.size() == b.history.joints.size());
  for (std::size_t k = 0; k < a.history.joints.size(); ++k)
    CHECK(a.history.joints[k].moment_Nm == b.history.joints[k].moment_Nm);
  CHECK(a.history.statistics.evaluations == b.history.statistics.evaluations);
  REQUIRE(a.channels.size() == b.channels.size());
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    CHECK(a.channels[k].name == b.channels[k].name);
    CHECK(a.channels[k].filter == b.channels[k].filter);
    CHECK((a.channels[k].values - b.channels[k].values).cwiseAbs().maxCoeff() < 1e-12);
  }
}

}  // namespace

TEST_CASE("outputs that come in blocks leave the files of a whole run") {
  const std::string channels =
      GENERATE(as<std::string>(), "", kChannels, std::string(kChannels) + kFiltered);
  const TemporaryFolder folder;
  const ModelFile model = model_in(folder, channels);
  write(model, folder / "whole", 1000);
  const HistoryFile whole = multibody::read_history(folder / "whole.h5");
  REQUIRE(whole.history.time_s.size() == 201);
  if (!channels.empty()) REQUIRE(whole.channels[0].values.cwiseAbs().maxCoeff() > 3.2);
  for (const Eigen::Index block : {1, 7, 67, 200}) {
    INFO(block);
    write(model, folder / "blocks", block);
    check_same(multibody::read_history(folder / "blocks.h5"), whole);
    // The table has the same numbers; counted angles may differ in their last digit.
    if (channels.empty()) CHECK(bytes_of(folder / "blocks.csv") == bytes_of(folder / "whole.csv"));
  }
}

TEST_CASE("outputs that neither the disk nor memory would take are refused at the first block") {
  const TemporaryFolder folder;
  const auto append_first = [&](const std::string& channels, Eigen::Index outputs) {
    const ModelFile model = model_in(folder, channels);
    SimulatedOutput output(model, folder / "a.h5", folder / "a.csv", outputs);
    output.append(multibody::simulate(model.model, model.solver, {0.01, 1e-3}));
  };
  const Eigen::Index giant = Eigen::Index{1} << 50U;
  CHECK_THROWS_AS(append_first("", giant), InputError);
  CHECK_THROWS_WITH(append_first("", giant), Contains("the history of 1125899906842624 outputs") &&
                                                 Contains("of disk space") &&
                                                 Contains("increase the output interval"));
  CHECK_NOTHROW(append_first(kFiltered, 1000));
  CHECK(fs::directory_iterator(folder.path()) != fs::directory_iterator());
  CHECK_FALSE(fs::exists(folder / "a.h5"));
}
