// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of a run's motion: the nodes of its deformable body for ParaView, and the recorded
// quantities as one table.
#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "geometry/foundation/atomic_folder.h"
#include "geometry/foundation/error.h"
#include "mesher/exchange/vtu_writer.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/exchange/mesh_modes.h"
#include "pipeline/process/result_files.h"
#include "pipeline/results/report/figures/bent_neck.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kMaxFrames = 200;

/// An interface and its motion, from which the frame of a deformable body is found.
struct Rider {
  const fe_modal::Interface* interface = nullptr;
  const multibody::MarkerHistory* marker = nullptr;
};

/// The interface that the modes move least: that of the fixed nodes, if there is one.
Rider rider_of(const multibody::History& history, const fe_modal::ModalBody& body) {
  const std::string& name = history.modal.front().body;
  Rider best;
  double least = 0;
  for (const fe_modal::Interface& each : body.interfaces) {
    const auto found =
        std::find_if(history.markers.begin(), history.markers.end(),
                     [&](const auto& marker) { return marker.name == name + "." + each.name; });
    const double motion = each.translation.norm() + each.rotation.norm();
    if (found == history.markers.end() || (best.marker != nullptr && motion >= least)) continue;
    best = {&each, &*found};
    least = motion;
  }
  return best;
}

/// Positions and deformations of all nodes in the world frame, one column each.
struct Frame {
  Eigen::Matrix3Xd nodes_m, deformation_m;
};

/// x = r + A (s + psi a), equations.md section 1; the interface's frame gives r and A.
Frame frame_at(const fe_modal::ModalBody& body, const Rider& rider, const BentNeck& bent,
               Index time) {
  const fe_modal::Interface& at = *rider.interface;
  const Eigen::Vector3d turn = at.rotation(Eigen::all, bent.modes) * bent.coordinates;
  const Eigen::Vector4d q = rider.marker->rotation.col(time);
  Eigen::Matrix3d A = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  if (turn.norm() > 0)
    A = A * Eigen::AngleAxisd(-turn.norm(), turn.normalized()).toRotationMatrix();
  const Eigen::Vector3d s =
      at.position_m + at.translation(Eigen::all, bent.modes) * bent.coordinates;
  Eigen::Matrix3Xd bending = Eigen::Matrix3Xd::Zero(3, body.nodes_m.cols());
  for (std::size_t k = 0; k < bent.modes.size(); ++k)
    bending += bent.coordinates[static_cast<Index>(k)] *
               body.shapes[static_cast<std::size_t>(bent.modes[k])];
  const Eigen::Vector3d origin = rider.marker->position_m.col(time) - A * s;
  return {(A * (body.nodes_m + bending)).colwise() + origin, A * bending};
}

std::span<const double> numbers(const Eigen::Matrix3Xd& columns) {
  return {columns.data(), static_cast<std::size_t>(columns.size())};
}

multibody::HistoryFile whole_run(const FileInput& input) {
  multibody::HistoryFile run = read_history(input.files.front());
  require_whole_run(input.files.front(), run.history);
  return run;
}

/// Channel of a vector with three components, or of a quaternion.
multibody::Channel channel(const std::string& of, const std::string& what, const std::string& unit,
                           const Eigen::MatrixXd& values) {
  const bool is_vector = values.rows() == 3;
  return {of + " " + what, unit,
          is_vector ? std::vector<std::string>{"x", "y", "z"}
                    : std::vector<std::string>{"w", "x", "y", "z"},
          values, ""};
}

std::vector<multibody::Channel> channels_of(const multibody::History& history) {
  std::vector<multibody::Channel> all;
  for (const multibody::MarkerHistory& marker : history.markers) {
    const std::string& of = marker.name;
    all.push_back(channel(of, "position", "m", marker.position_m));
    all.push_back(channel(of, "velocity", "m/s", marker.velocity_m_s));
    all.push_back(channel(of, "acceleration", "m/s^2", marker.acceleration_m_s2));
    all.push_back(channel(of, "quaternion", "1", marker.rotation));
    all.push_back(channel(of, "angular velocity", "rad/s", marker.angular_velocity_rad_s));
    all.push_back(
        channel(of, "angular acceleration", "rad/s^2", marker.angular_acceleration_rad_s2));
  }
  for (const multibody::JointHistory& joint : history.joints) {
    all.push_back(channel(joint.name, "force", "N", joint.force_N));
    all.push_back(channel(joint.name, "moment", "N*m", joint.moment_Nm));
  }
  for (const multibody::ModalHistory& modal : history.modal)
    all.push_back({modal.body, "kg^(1/2)*m", modal.modes, modal.coordinates, ""});
  return all;
}

}  // namespace

void export_motion_csv(const FileInput& input) {
  const multibody::HistoryFile run = whole_run(input);
  write_csv(input.target, run.history.time_s, channels_of(run.history));
}

void export_motion_pvd(const FileInput& input) {
  const fs::path& file = input.files.front();
  const multibody::History history = whole_run(input).history;
  if (history.modal.empty())
    throw InputError(
        file.string() +
        ": expected a run with a deformable body, whose mesh is exported, found only rigid bodies");
  const ResultsFolder folder(file.parent_path());
  const mesher::Mesh mesh = read_mesh(folder.mesh()).mesh;
  const fe_modal::ModalBody body = read_modal_body(folder.modes()).body;
  require_modes_of(mesh, body, folder.modes());
  if (!bent_neck(history, body, 0))
    throw InputError(file.string() +
                     ": expected a run with one deformable body with the modes of " +
                     folder.modes().string() + ", found another one");
  const Rider rider = rider_of(history, body);
  if (rider.marker == nullptr)
    throw InputError(
        file.string() +
        ": contains none of the interfaces of the deformable body; add one to output.markers");
  const std::string name = input.target.stem().string();
  AtomicFolder frames(input.target.parent_path() / name);
  const mesher::VtuWriter writer(mesh);
  std::vector<mesher::TimedFile> files;
  const Index stride = (history.time_s.size() + kMaxFrames - 1) / kMaxFrames;
  for (Index k = 0; k < history.time_s.size(); k += stride) {
    const Frame frame = frame_at(body, rider, *bent_neck(history, body, k), k);
    const std::string vtu = fmt::format("{}_{:04}.vtu", name, files.size());
    writer.write(frames / vtu, numbers(frame.nodes_m),
                 {{"deformation [m]", numbers(frame.deformation_m)}});
    files.push_back({history.time_s[k], name + "/" + vtu});
  }
  frames.commit();
  mesher::write_pvd(input.target, files);
  input.console.result(
      fmt::format("{}: {} frames in {}", input.target.string(), files.size(), name + "/"));
}

}  // namespace flexneck::pipeline
