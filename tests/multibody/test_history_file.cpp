// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_writer.h"
#include "tests/support/files.h"
#include "tests/support/point_mass_body.h"

using namespace flexneck;
using namespace flexneck::multibody;
using testing::bytes_of;

namespace {

constexpr Eigen::Index kTimes = 5;

template <class Matrix>
Matrix random_columns(testing::RandomNumbers& random, Eigen::Index rows) {
  Matrix values(rows, kTimes);
  random.fill(values);
  return values;
}

MarkerHistory random_marker(testing::RandomNumbers& random, const std::string& name) {
  return {name,
          random_columns<Eigen::Matrix3Xd>(random, 3),
          random_columns<Eigen::Matrix3Xd>(random, 3),
          random_columns<Eigen::Matrix3Xd>(random, 3),
          random_columns<Eigen::Matrix4Xd>(random, 4),
          random_columns<Eigen::Matrix3Xd>(random, 3),
          random_columns<Eigen::Matrix3Xd>(random, 3)};
}

/// A history whose names are not in alphabetical order.
HistoryFile random_history() {
  testing::RandomNumbers random(7);
  HistoryFile file;
  History& history = file.history;
  history.time_s = Eigen::VectorXd::LinSpaced(kTimes, 0, 0.004);
  history.markers = {random_marker(random, "top"), random_marker(random, "head cg")};
  history.joints = {{"neck base", random_columns<Eigen::Matrix3Xd>(random, 3),
                     random_columns<Eigen::Matrix3Xd>(random, 3)},
                    {"OC", random_columns<Eigen::Matrix3Xd>(random, 3),
                     random_columns<Eigen::Matrix3Xd>(random, 3)}};
  history.modal = {
      {"neck", {"fore-aft bending 1", "twist 1"}, random_columns<Eigen::MatrixXd>(random, 2)}};
  history.energy = {random.vector(kTimes), random.vector(kTimes), random.vector(kTimes),
                    random.vector(kTimes), random.vector(kTimes)};
  history.constraints = {random.vector(kTimes), random.vector(kTimes), random.vector(kTimes),
                         random.vector(kTimes)};
  history.statistics = {311, 4, 2196, 1.5e-16, 2.5e-15, {}};
  file.provenance.program = "flexneck 0.1.0";
  file.provenance.git_hash = "unknown";
  return file;
}

}  // namespace

TEST_CASE("A history comes back from its file to the last bit and in its order") {
  const TemporaryFolder folder;
  const HistoryFile file = random_history();
  write_history(folder / "h.h5", file);
  const History read = read_history(folder / "h.h5").history;
  const History& written = file.history;
  CHECK(read.time_s == written.time_s);
  REQUIRE(read.markers.size() == written.markers.size());
  for (std::size_t k = 0; k < written.markers.size(); ++k) {
    CHECK(read.markers[k].name == written.markers[k].name);
    CHECK(read.markers[k].position_m == written.markers[k].position_m);
    CHECK(read.markers[k].velocity_m_s == written.markers[k].velocity_m_s);
    CHECK(read.markers[k].acceleration_m_s2 == written.markers[k].acceleration_m_s2);
    CHECK(read.markers[k].rotation == written.markers[k].rotation);
    CHECK(read.markers[k].angular_velocity_rad_s == written.markers[k].angular_velocity_rad_s);
    CHECK(read.markers[k].angular_acceleration_rad_s2 ==
          written.markers[k].angular_acceleration_rad_s2);
  }
  REQUIRE(read.joints.size() == written.joints.size());
  for (std::size_t k = 0; k < written.joints.size(); ++k) {
    CHECK(read.joints[k].name == written.joints[k].name);
    CHECK(read.joints[k].force_N == written.joints[k].force_N);
    CHECK(read.joints[k].moment_Nm == written.joints[k].moment_Nm);
  }
  REQUIRE(read.modal.size() == 1);
  CHECK(read.modal[0].body == "neck");
  CHECK(read.modal[0].modes == written.modal[0].modes);
  CHECK(read.modal[0].coordinates == written.modal[0].coordinates);
  CHECK(read.energy.kinetic_J == written.energy.kinetic_J);
  CHECK(read.energy.gravitational_J == written.energy.gravitational_J);
  CHECK(read.energy.strain_J == written.energy.strain_J);
  CHECK(read.energy.dissipated_J == written.energy.dissipated_J);
  CHECK(read.energy.work_J == written.energy.work_J);
  CHECK(read.constraints.position_m == written.constraints.position_m);
  CHECK(read.constraints.orientation_rad == written.constraints.orientation_rad);
  CHECK(read.constraints.velocity_m_s == written.constraints.velocity_m_s);
  CHECK(read.constraints.angular_velocity_rad_s == written.constraints.angular_velocity_rad_s);
  CHECK(read.statistics.accepted == 311);
  CHECK(read.statistics.rejected == 4);
  CHECK(read.statistics.evaluations == 2196);
  CHECK(read.statistics.max_position_residual == 1.5e-16);
  CHECK(read.statistics.max_velocity_residual == 2.5e-15);
  CHECK(read_history(folder / "h.h5").provenance.program == "flexneck 0.1.0");
}

TEST_CASE("What a run says of itself comes back from its file") {
  const TemporaryFolder folder;
  HistoryFile file = random_history();
  History& run = file.history;
  run.incomplete = "the step size fell below 1e-10 s at 0.004 s";
  run.warnings = {"body 'neck' turns its interface 'top' by 64.7 deg", "second"};
  run.redundant_constraints = {"joint 'OC', position row 1"};
  run.joints[1].undetermined = "force x, moment z";
  run.statistics.limits = {{"error: rate of joint 'OC'", 7}, {"the largest step", 2}};
  testing::RandomNumbers random(3);
  file.channels = {
      {"rotation", "rad", {"y"}, random_columns<Eigen::MatrixXd>(random, 1), "CFC 60"}};
  write_history(folder / "h.h5", file);
  const HistoryFile read = read_history(folder / "h.h5");
  CHECK(read.history.incomplete == run.incomplete);
  CHECK(read.history.warnings == run.warnings);
  CHECK(read.history.redundant_constraints == run.redundant_constraints);
  CHECK(read.history.joints[0].undetermined.empty());
  CHECK(read.history.joints[1].undetermined == "force x, moment z");
  REQUIRE(read.history.statistics.limits.size() == 2);
  CHECK(read.history.statistics.limits[0].what == "error: rate of joint 'OC'");
  CHECK(read.history.statistics.limits[0].steps == 7);
  CHECK(read.history.statistics.limits[1].steps == 2);
  REQUIRE(read.channels.size() == 1);
  CHECK(read.channels[0].unit == "rad");
  CHECK(read.channels[0].filter == "CFC 60");
  CHECK(read.channels[0].columns == std::vector<std::string>{"y"});
  CHECK(read.channels[0].values == file.channels[0].values);
}

TEST_CASE("A body without modes has a history in blocks, too") {
  const TemporaryFolder folder;
  HistoryFile file = random_history();
  file.history.modal[0] = {"neck", {}, Eigen::MatrixXd(0, kTimes)};
  file.channels = {{"modal", "kg^(1/2) m", {}, Eigen::MatrixXd(0, kTimes), ""}};
  HistoryWriter writer(folder / "h.h5");
  writer.append(file.history, file.channels);
  HistoryFile last = file;
  last.history.handed_on = kTimes;
  last.history.time_s.array() += 0.005;
  writer.finish(last);
  const HistoryFile read = read_history(folder / "h.h5");
  REQUIRE(read.history.time_s.size() == 2 * kTimes);
  CHECK(read.history.time_s.tail(kTimes) == last.history.time_s);
  CHECK(read.history.modal[0].coordinates.cols() == 2 * kTimes);
  CHECK(read.history.joints[1].force_N.rightCols(kTimes) == file.history.joints[1].force_N);
}

TEST_CASE("The layout is the one the README tells: time first, then components") {
  const TemporaryFolder folder;
  const HistoryFile file = random_history();
  write_history(folder / "h.h5", file);
  const Hdf5Reader reader(folder / "h.h5", kHistoryFormat);
  const std::vector<double> position =
      reader.read_doubles("/markers/head cg/position", {kTimes, 3}, "m");
  CHECK(position[1] == file.history.markers[1].position_m(1, 0));
  CHECK(position[3] == file.history.markers[1].position_m(0, 1));
  const std::vector<double> modal =
      reader.read_doubles("/modal/neck/coordinates", {kTimes, 2}, "kg^(1/2) m");
  CHECK(modal[1] == file.history.modal[0].coordinates(1, 0));
}

TEST_CASE("The same history gives the same bytes") {
  const TemporaryFolder folder;
  write_history(folder / "a.h5", random_history());
  write_history(folder / "b.h5", random_history());
  CHECK(bytes_of(folder / "a.h5") == bytes_of(folder / "b.h5"));
}

TEST_CASE("A history with names that cannot be groups leaves no file") {
  const TemporaryFolder folder;
  HistoryFile file = random_history();
  file.history.joints[0].name = "neck/base";
  CHECK_THROWS_WITH(write_history(folder / "h.h5", file),
                    Catch::Contains("neck/base") && Catch::Contains("'/'"));
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("A history whose arrays do not fit its times is refused") {
  const TemporaryFolder folder;
  HistoryFile file = random_history();
  file.history.joints[1].moment_Nm.conservativeResize(3, kTimes - 1);
  write_history(folder / "h.h5", file);
  CHECK_THROWS_WITH(read_history(folder / "h.h5"),
                    Catch::Contains("/joints/OC/moment") && Catch::Contains("(5, 3)"));
  file = random_history();
  file.history.time_s[2] = file.history.time_s[1];
  write_history(folder / "t.h5", file);
  CHECK_THROWS_WITH(read_history(folder / "t.h5"), Catch::Contains("row 3"));
}

TEST_CASE("Steps of a history are counted from 0") {
  const TemporaryFolder folder;
  HistoryFile file = random_history();
  file.history.statistics.limits = {{"error: angle", 300}, {"output", 0}};
  write_history(folder / "h.h5", file);
  CHECK(read_history(folder / "h.h5").history.statistics.limits[0].steps == 300);
  file.history.statistics.limits[1].steps = -1;
  write_history(folder / "limits.h5", file);
  CHECK_THROWS_WITH(read_history(folder / "limits.h5"),
                    Catch::Contains("/statistics/limited_steps") && Catch::Contains("found -1"));
  file = random_history();
  file.history.statistics.rejected = -7;
  write_history(folder / "rejected.h5", file);
  CHECK_THROWS_WITH(read_history(folder / "rejected.h5"),
                    Catch::Contains("/statistics/rejected") && Catch::Contains("found -7"));
}

TEST_CASE("A truncated history is refused with one line") {
  const TemporaryFolder folder;
  write_history(folder / "h.h5", random_history());
  std::filesystem::resize_file(folder / "h.h5", std::filesystem::file_size(folder / "h.h5") / 2);
  CHECK_THROWS_AS(read_history(folder / "h.h5"), InputError);
}

TEST_CASE("Looking up a marker or joint that is not there names those that are") {
  const History history = random_history().history;
  CHECK(&history.marker("head cg") == &history.markers[1]);
  CHECK(&history.joint("OC") == &history.joints[1]);
  CHECK_THROWS_WITH(history.marker("hed cg"),
                    Catch::Contains("did you mean 'head cg'") && Catch::Contains("'top'"));
  CHECK_THROWS_WITH(history.joint("chin"), Catch::Contains("'neck base' 'OC'"));
}
