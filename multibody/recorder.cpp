// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/recorder.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <Eigen/Geometry>

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::array<VectorXd*, 4> parts_of(ConstraintHistory& constraints) {
  return {&constraints.position_m, &constraints.orientation_rad, &constraints.velocity_m_s,
          &constraints.angular_velocity_rad_s};
}

}  // namespace

VectorXd output_times(const OutputOptions& output) {
  constexpr double kSlack = 1e-9;  // of an interval: the end may be a multiple but for rounding
  const auto whole = static_cast<Index>(output.end_time_s / output.interval_s + kSlack);
  const bool end_is_multiple = output.end_time_s - static_cast<double>(whole) * output.interval_s <=
                               kSlack * output.interval_s;
  VectorXd times(whole + (end_is_multiple ? 1 : 2));
  for (Index k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) * output.interval_s;
  times[times.size() - 1] = output.end_time_s;
  return times;
}

Recorder::Recorder(const Model& model, const VectorXd& times_s)
    : modal_of_body_(model.bodies.size(), 0),
      undetermined_(model.joints.size(), Eigen::Array<bool, 6, 1>::Constant(false)) {
  const Index n = times_s.size();
  history_.time_s = times_s;
  for (const Marker& marker : model.markers) {
    history_.markers.push_back({marker.name, Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n),
                                Eigen::Matrix3Xd(3, n), Eigen::Matrix4Xd(4, n),
                                Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)});
  }
  for (const Joint& joint : model.joints)
    history_.joints.push_back({joint.name, Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)});
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto* deformable = std::get_if<DeformableBody>(&model.bodies[b].kind);
    if (deformable == nullptr) continue;
    ModalHistory modal{
        model.bodies[b].name, {}, Eigen::MatrixXd(deformable->modes.mode_count(), n)};
    for (const fe_modal::ModeRecord& mode : deformable->modes.modes)
      modal.modes.push_back(mode.name);
    modal_of_body_[b] = history_.modal.size();
    history_.modal.push_back(std::move(modal));
  }
  EnergyHistory& energy = history_.energy;
  for (VectorXd* part : {&energy.kinetic_J, &energy.gravitational_J, &energy.strain_J,
                         &energy.dissipated_J, &energy.work_J}) {
    part->setZero(n);
  }
  for (VectorXd* part : parts_of(history_.constraints)) part->setZero(n);
}

void Recorder::marker(Index column, std::size_t index, const MarkerState& motion) {
  MarkerHistory& marker = history_.markers[index];
  marker.position_m.col(column) = motion.position_m;
  marker.velocity_m_s.col(column) = motion.velocity_m_s;
  marker.angular_velocity_rad_s.col(column) = motion.angular_velocity_rad_s;
  marker.acceleration_m_s2.col(column) = motion.acceleration_m_s2;
  marker.angular_acceleration_rad_s2.col(column) = motion.angular_acceleration_rad_s2;
  // Of the two quaternions of a rotation, the one near the last.
  const Eigen::Quaterniond q(motion.rotation);
  Eigen::Vector4d rotation(q.w(), q.x(), q.y(), q.z());
  if (column > 0 && rotation.dot(marker.rotation.col(column - 1)) < 0) rotation = -rotation;
  marker.rotation.col(column) = rotation;
}

void Recorder::joint(Index column, std::size_t index, const Reaction& world,
                     const Eigen::Matrix3d& R_i) {
  JointHistory& joint = history_.joints[index];
  joint.force_N.col(column) = R_i.transpose() * world.force_N;
  joint.moment_Nm.col(column) = R_i.transpose() * world.moment_Nm;
}

void Recorder::modal(Index column, std::size_t body, const VectorXd& a) {
  if (a.size() > 0) history_.modal[modal_of_body_[body]].coordinates.col(column) = a;
}

void Recorder::energy(Index column, const Energies& stored, double dissipated_J, double work_J) {
  EnergyHistory& energy = history_.energy;
  energy.kinetic_J[column] = stored.kinetic_J;
  energy.gravitational_J[column] = stored.gravitational_J;
  energy.strain_J[column] = stored.strain_J;
  energy.dissipated_J[column] = dissipated_J;
  energy.work_J[column] = work_J;
}

void Recorder::residuals(Index column, const Violation& position, const Violation& velocity) {
  const auto keep = [](double& largest, double value) { largest = std::max(largest, value); };
  ConstraintHistory& constraints = history_.constraints;
  keep(constraints.position_m[column], position.translation);
  keep(constraints.orientation_rad[column], position.rotation);
  keep(constraints.velocity_m_s[column], velocity.translation);
  keep(constraints.angular_velocity_rad_s[column], velocity.rotation);
  StepStatistics& statistics = history_.statistics;
  keep(statistics.largest_position_residual, std::max(position.translation, position.rotation));
  keep(statistics.largest_velocity_residual, std::max(velocity.translation, velocity.rotation));
}

void Recorder::undetermined(std::size_t joint, const Eigen::Array<bool, 6, 1>& components) {
  undetermined_[joint] = undetermined_[joint] || components;
}

void Recorder::redundant(std::vector<std::string> constraints) {
  history_.redundant_constraints = std::move(constraints);
}

History Recorder::take() {
  constexpr std::array<const char*, 6> kNames = {"force x",  "force y",  "force z",
                                                 "moment x", "moment y", "moment z"};
  for (std::size_t k = 0; k < undetermined_.size(); ++k)
    for (std::size_t c = 0; c < kNames.size(); ++c) {
      if (!undetermined_[k][static_cast<Index>(c)]) continue;
      std::string& text = history_.joints[k].undetermined;
      text += (text.empty() ? "" : ", ") + std::string(kNames[c]);
    }
  return std::move(history_);
}

History Recorder::take_incomplete(Index columns, const std::string& why) {
  const auto cut = [columns](auto& values) { values.conservativeResize(Eigen::NoChange, columns); };
  history_.incomplete = why;
  history_.time_s.conservativeResize(columns);
  for (MarkerHistory& marker : history_.markers) {
    for (Eigen::Matrix3Xd* each :
         {&marker.position_m, &marker.velocity_m_s, &marker.acceleration_m_s2,
          &marker.angular_velocity_rad_s, &marker.angular_acceleration_rad_s2})
      cut(*each);
    cut(marker.rotation);
  }
  for (JointHistory& joint : history_.joints) {
    cut(joint.force_N);
    cut(joint.moment_Nm);
  }
  for (ModalHistory& modal : history_.modal) cut(modal.coordinates);
  EnergyHistory& energy = history_.energy;
  for (VectorXd* part : {&energy.kinetic_J, &energy.gravitational_J, &energy.strain_J,
                         &energy.dissipated_J, &energy.work_J})
    part->conservativeResize(columns);
  for (VectorXd* part : parts_of(history_.constraints)) part->conservativeResize(columns);
  return take();
}

}  // namespace flexneck::multibody
