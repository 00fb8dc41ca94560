// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iterator>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "multibody/signals/load_cell.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/results/tables/csv_output.h"
#include "tests/support/model_text.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::Channel;

namespace {

constexpr double kRounding = 1e-12;

/// A run of a double pendulum, and channels of it given by the text of their tables.
struct Swing {
  TemporaryFolder folder;
  ModelFile file;
  multibody::History history;

  explicit Swing(const std::string& channels, const std::string& interval = "1 ms")
      : file(read_model_file(testing::write_test_file(folder / "swing.toml",
                                                      testing::double_pendulum_text() + channels),
                             {"output.interval=" + interval})),
        history(multibody::simulate(file.model, file.solver,
                                    {file.end_time_s, file.output.interval_s})) {}

  Channel channel(std::size_t k) const {
    return channel_of(history, file.output.channels.at(k), file.model.gravity_m_s2);
  }
};

std::string channel_text(const std::string& quantity, const std::string& keys) {
  static int count = 0;
  return "\n[[channel]]\nname = \"c" + std::to_string(++count) + "\"\nquantity = \"" + quantity +
         "\"\n" + keys + "\n";
}

/// Largest deviation of a rate from fourth-order central differences.
double difference_error(const Eigen::MatrixXd& values, const Eigen::MatrixXd& rates, double dt) {
  double largest = 0;
  for (Eigen::Index k = 2; k + 2 < values.cols(); ++k) {
    const Eigen::VectorXd slope =
        (8 * (values.col(k + 1) - values.col(k - 1)) - (values.col(k + 2) - values.col(k - 2))) /
        (12 * dt);
    largest = std::max(largest, (slope - rates.col(k)).norm());
  }
  return largest / rates.colwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("motion seen from a frame that turns is what differences of its positions show") {
  const std::string seen = "marker = \"lower.tip\"\nrelative_to = \"upper.end\"";
  const Swing swing(channel_text("position", seen) + channel_text("velocity", seen) +
                    channel_text("acceleration", seen) + channel_text("angular_velocity", seen) +
                    channel_text("angular_acceleration", seen) +
                    channel_text("angle", seen + "\naxis = [1, 0, 0]"));
  // Error h^4 of the differences for motions of about 2 Hz.
  constexpr double kDifference = 1e-6;
  CHECK(difference_error(swing.channel(0).values, swing.channel(1).values, 1e-3) < kDifference);
  CHECK(difference_error(swing.channel(1).values, swing.channel(2).values, 1e-3) < kDifference);
  CHECK(difference_error(swing.channel(3).values, swing.channel(4).values, 1e-3) < kDifference);
  // The elbow permits rotation about x only. The markers' axes are rotated by 30 deg there.
  const Eigen::MatrixXd turning = swing.channel(3).values;
  CHECK(turning.bottomRows<2>().cwiseAbs().maxCoeff() < kRounding * turning.cwiseAbs().maxCoeff());
  CHECK(difference_error(swing.channel(5).values, turning.row(0), 1e-3) < kDifference);
  CHECK(swing.channel(5).values(0, 0) == Approx(-70 * std::numbers::pi / 180).epsilon(kRounding));
}

TEST_CASE("an accelerometer reads its acceleration less gravity in its own axes") {
  const Swing swing(channel_text("accelerometer", "marker = \"lower.tip\"") +
                    channel_text("acceleration", "marker = \"lower.tip\"\naxes = \"lower.tip\"") +
                    channel_text("accelerometer", "marker = \"ground.hook\"") +
                    channel_text("quaternion", "marker = \"lower.tip\""));
  for (Eigen::Index k = 0; k < swing.history.time_s.size(); ++k) {
    const auto q = swing.history.marker("lower.tip").rotation.col(k);
    const Eigen::Vector3d up =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * Eigen::Vector3d(0, 0, 9.80665);
    CHECK((swing.channel(0).values.col(k) - swing.channel(1).values.col(k) - up).norm() < 1e-10);
    CHECK((swing.channel(2).values.col(k) - Eigen::Vector3d(0, 0, 9.80665)).norm() < kRounding);
    if (k % 50 == 0) CHECK((swing.channel(3).values.col(k) - q).norm() < kRounding);
  }
}

TEST_CASE("reactions come in the axes of either side and as a load cell has them") {
  const Swing swing(channel_text("force", "joint = \"elbow\"") +
                    channel_text("force", "joint = \"elbow\"\naxes = \"lower.top\"") +
                    channel_text("load_cell_moment", "joint = \"shoulder\""));
  const multibody::JointHistory& elbow = swing.history.joint("elbow");
  CHECK(swing.channel(0).values == Eigen::MatrixXd(elbow.force_N));
  // The axes have x in common; y and z rotate with the elbow.
  const Eigen::MatrixXd turned = swing.channel(1).values;
  CHECK((turned.row(0) - elbow.force_N.row(0)).norm() < kRounding * elbow.force_N.norm());
  CHECK((turned.colwise().norm() - elbow.force_N.colwise().norm()).norm() <
        kRounding * elbow.force_N.norm());
  CHECK((turned.row(1) - elbow.force_N.row(1)).norm() > 0.1 * elbow.force_N.norm());
  CHECK(swing.channel(2).values.row(1) == -swing.history.joint("shoulder").moment_Nm.row(1));
}

TEST_CASE("an angle starts with that of its joint, and a filter keeps slow signals and its name") {
  const Swing swing(channel_text("angle", "marker = \"upper.top\"\naxis = [0, 1, 0]") +
                        channel_text("velocity", "marker = \"lower.tip\"\nfilter = \"CFC 60\"") +
                        channel_text("energy", ""),
                    "0.3 ms");  // 0.2 s is no multiple
  CHECK(swing.channel(0).values(0, 0) == Approx(40 * std::numbers::pi / 180).epsilon(kRounding));
  const Channel slow = swing.channel(1);
  CHECK(slow.filter == "CFC 60");
  const Eigen::MatrixXd plain = swing.history.marker("lower.tip").velocity_m_s;
  CHECK((slow.values - plain).norm() > 0);
  CHECK((slow.values - plain).norm() < 1e-3 * plain.norm());  // 100 Hz against a few
  const Eigen::VectorXd balance = swing.channel(2).values.row(5);
  CHECK((balance.array() - balance[0]).abs().maxCoeff() < 1e-7);
}

TEST_CASE("channels come back from the history file") {
  const Swing swing(channel_text("position", "marker = \"lower.tip\"\nfilter = \"CFC 60\""));
  multibody::HistoryFile file{swing.history, {swing.channel(0)}, {}};
  multibody::write_history(swing.folder / "swing.h5", file);
  const multibody::HistoryFile back = multibody::read_history(swing.folder / "swing.h5");
  REQUIRE(back.channels.size() == 1);
  CHECK(back.channels[0].name == file.channels[0].name);
  CHECK(back.channels[0].unit == "m");
  CHECK(back.channels[0].filter == "CFC 60");
  CHECK(back.channels[0].columns == file.channels[0].columns);
  CHECK(back.channels[0].values == file.channels[0].values);
}

TEST_CASE("a table has the components of a vector in the order of their names, row by row") {
  const TemporaryFolder folder;
  Channel place{"place", "m", {"x", "y", "z"}, Eigen::MatrixXd(3, 2), ""};
  place.values << 1, 4, 2, 5, 3, 6;  // (1, 2, 3) at first, then (4, 5, 6)
  const Channel load{"load, \"axial\"", "N", {"load"}, Eigen::RowVector2d(-0.1, 8), ""};
  write_csv(folder / "t.csv", Eigen::Vector2d(0, 0.5), {place, load}, "time [s]");
  std::ifstream file(folder / "t.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK(text ==
        "time [s],place x [m],place y [m],place z [m],\"load, \"\"axial\"\" [N]\"\n"
        "0,1,2,3,-0.1\n"
        "0.5,4,5,6,8\n");
}
