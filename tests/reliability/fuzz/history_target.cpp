// SPDX-License-Identifier: GPL-3.0-or-later
// Target: histories, see hdf5_edits.h.
#include "multibody/analysis/linearisation.h"
#include "multibody/files/history_file.h"
#include "tests/reliability/fuzz/hdf5_target.h"
#include "tests/support/point_mass_body.h"

using namespace flexneck;
using namespace flexneck::multibody;

namespace {

constexpr Eigen::Index kTimes = 3;

template <class Matrix = Eigen::Matrix3Xd>
Matrix curves(testing::RandomNumbers& random, Eigen::Index rows = 3) {
  Matrix values(rows, kTimes);
  random.fill(values);
  return values;
}

LinearisationRecord sound_linearisation() {
  ModeShape shape;
  shape.mode.frequency_Hz = 2;
  shape.translation = Eigen::Matrix3Xcd::Ones(3, 1);
  shape.rotation = Eigen::Matrix3Xcd::Zero(3, 1);
  return {"equilibrium", {"top"}, {shape, shape}};
}

/// Writes a history with an example of everything that such a file may hold.
void write_sound(const std::filesystem::path& path) {
  testing::RandomNumbers random(7);
  HistoryFile file;
  History& history = file.history;
  history.time_s = Eigen::VectorXd::LinSpaced(kTimes, 0, 0.002);
  history.markers = {{"top", curves(random), curves(random), curves(random),
                      curves<Eigen::Matrix4Xd>(random, 4), curves(random), curves(random)}};
  history.joints = {{"pin", curves(random), curves(random), "force y"}};
  history.modal = {{"neck", {"bending 1", "twist 1"}, curves<Eigen::MatrixXd>(random, 2)}};
  history.energy = {random.vector(kTimes), random.vector(kTimes), random.vector(kTimes),
                    random.vector(kTimes), random.vector(kTimes)};
  history.constraints = {random.vector(kTimes), random.vector(kTimes), random.vector(kTimes),
                         random.vector(kTimes)};
  history.statistics = {311, 4, 2196, 1.5e-16, 2.5e-15, {{"error: angle", 300}}};
  history.redundant_constraints = {"joint 'pin', row 4"};
  history.warnings = {"a warning"};
  history.incomplete = "it ended";
  file.channels = {{"head", "gn", {"x", "y"}, curves<Eigen::MatrixXd>(random, 2), "CFC 600"}};
  file.linearisation = sound_linearisation();
  file.provenance = {"program",
                     "hash",
                     {{"m.toml", "0"}},
                     {{"key", "1 m", Origin::published, "note"}},
                     {{"Eigen", "3"}}};
  write_history(path, file);
}

template <class Matrix>
void check_curves(const Matrix& curves, Eigen::Index times) {
  fuzz::require(curves.cols() == times && curves.allFinite(), "a curve has a value at each time");
}

void check(const HistoryFile& file) {
  const History& history = file.history;
  const Eigen::Index times = history.time_s.size();
  fuzz::require(history.time_s.allFinite(), "times are finite");
  for (Eigen::Index k = 1; k < times; ++k)
    fuzz::require(history.time_s[k] > history.time_s[k - 1], "times increase");
  for (const MarkerHistory& marker : history.markers) {
    check_curves(marker.position_m, times);
    check_curves(marker.rotation, times);
    check_curves(marker.angular_acceleration_rad_s2, times);
  }
  for (const JointHistory& joint : history.joints) check_curves(joint.moment_Nm, times);
  for (const ModalHistory& modal : history.modal) {
    check_curves(modal.coordinates, times);
    fuzz::require(static_cast<std::size_t>(modal.coordinates.rows()) == modal.modes.size(),
                  "every coordinate has a name");
  }
  for (const Channel& channel : file.channels) {
    check_curves(channel.values, times);
    fuzz::require(static_cast<std::size_t>(channel.values.rows()) == channel.columns.size(),
                  "every curve has a name");
  }
  check_curves(history.energy.work_J.transpose(), times);
  const StepStatistics& steps = history.statistics;
  fuzz::require(steps.accepted >= 0 && steps.rejected >= 0 && steps.evaluations >= 0,
                "steps are counted");
  for (const StepLimit& limit : steps.limits)
    fuzz::require(limit.steps >= 0, "steps are counted by what limits them");
  if (!file.linearisation) return;
  for (const ModeShape& mode : file.linearisation->modes)
    fuzz::require(
        static_cast<std::size_t>(mode.translation.cols()) == file.linearisation->markers.size() &&
            mode.rotation.cols() == mode.translation.cols(),
        "a shape moves all markers");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Hdf5Target target(write_sound);
  return target.run(data, size, [](const std::filesystem::path& path) {
    const HistoryFile file = read_history(path);
    check(file);
    // A foreign file is used in a run after it has been written as a copy of this program.
    const std::filesystem::path copy = target.folder().path() / "copy.h5";
    write_history(copy, file);
    const History again = read_history(copy).history;
    fuzz::require(again.time_s == file.history.time_s &&
                      again.markers.size() == file.history.markers.size() &&
                      again.joints.size() == file.history.joints.size() &&
                      again.statistics.accepted == file.history.statistics.accepted,
                  "a history is written and read");
  });
}
