// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/recorder.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "multibody/history/history_arrays.h"

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Keeps the first columns, or entries, of an array.
template <class Array>
void resize(Array& values, Index columns) {
  if constexpr (kIsOnePerTime<Array>)
    values.conservativeResize(columns);
  else
    values.conservativeResize(Eigen::NoChange, columns);
}

}  // namespace

OutputTimes::OutputTimes(const OutputOptions& output)
    : begin_s_(output.begin_time_s), interval_s_(output.interval_s), end_s_(output.end_time_s) {
  constexpr double kSlack = 1e-9;  // fraction of the interval: rounding of the end
  const double length = end_s_ - begin_s_;
  const auto whole = static_cast<Index>(length / interval_s_ + kSlack);
  const bool end_is_multiple =
      length - static_cast<double>(whole) * interval_s_ <= kSlack * interval_s_;
  count_ = whole + (end_is_multiple ? 1 : 2);
}

Index numbers_per_output(const Model& model) {
  OutputOptions one;
  one.end_time_s = one.interval_s;
  return numbers_per_output(Recorder(model, one).take());
}

Recorder::Recorder(const Model& model, const OutputOptions& output, RunWatch watch)
    : times_(output),
      block_(output.sink ? std::max<Index>(output.block, 1) : times_.count()),
      sink_(output.sink),
      watch_(std::move(watch)),
      modal_of_body_(model.bodies.size(), 0),
      state_of_body_(model.bodies.size(), 0),
      state_of_joint_(model.joints.size(), 0),
      watched_(model.markers.size()),
      last_rotations_(model.markers.size(), Eigen::Vector4d::Zero()),
      undetermined_(model.joints.size(), Eigen::Array<bool, 6, 1>::Constant(false)) {
  for (const Marker& marker : model.markers) history_.markers.emplace_back().name = marker.name;
  for (const Joint& joint : model.joints) history_.joints.emplace_back().name = joint.name;
  for (const MeasuredAngle& angle : model.angles) history_.angles.emplace_back().name = angle.name;
  for (std::size_t k = 0; k < watch_.markers().size(); ++k) watched_[watch_.markers()[k]] = k;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto* deformable = std::get_if<DeformableBody>(&model.bodies[b].kind);
    if (deformable == nullptr) continue;
    ModalHistory modal{model.bodies[b].name, {}, {}};
    modal.coordinates.resize(deformable->modes.mode_count(), 0);
    for (const fe_modal::ModeRecord& mode : deformable->modes.modes)
      modal.modes.push_back(mode.name);
    modal_of_body_[b] = history_.modal.size();
    history_.modal.push_back(std::move(modal));
  }
  if (output.states) prepare_states(model);
  make_room();
}

void Recorder::prepare_states(const Model& model) {
  StateHistory& states = history_.state;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (std::holds_alternative<PrescribedBody>(model.bodies[b].kind)) continue;
    const auto* deformable = std::get_if<DeformableBody>(&model.bodies[b].kind);
    const Index m = deformable == nullptr ? 0 : deformable->modes.mode_count();
    state_of_body_[b] = states.bodies.size();
    BodyHistory& body = states.bodies.emplace_back();
    body.name = model.bodies[b].name;
    body.inertia = inertia_of(model.bodies[b]);
    body.modal.resize(m, 0);
    body.modal_rate.resize(m, 0);
  }
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    if (!model.joints[k].kind->has_angle) continue;
    state_of_joint_[k] = states.angle_names.size();
    states.angle_names.push_back("joint " + model.joints[k].name);
  }
  for (const MeasuredAngle& angle : model.angles)
    states.angle_names.push_back("angle " + angle.name);
  states.angles.resize(static_cast<Index>(states.angle_names.size()), 0);
}

void Recorder::joint_angle(Index column, std::size_t joint, double angle_rad) {
  history_.state.angles(static_cast<Index>(state_of_joint_[joint]), place(column)) = angle_rad;
}

void Recorder::state(Index column, std::size_t body, const BodyState& motion) {
  BodyHistory& state = history_.state.bodies[state_of_body_[body]];
  column = place(column);
  const Eigen::Quaterniond q(motion.rotation);
  state.position_m.col(column) = motion.position_m;
  state.rotation.col(column) << q.w(), q.x(), q.y(), q.z();
  state.velocity_m_s.col(column) = motion.velocities.head<3>();
  state.angular_velocity_rad_s.col(column) = motion.velocities.segment<3>(3);
  state.modal.col(column) = motion.modal;
  state.modal_rate.col(column) = motion.velocities.tail(motion.modal.size());
}

void Recorder::internal(Index column, const VectorXd& variables) {
  Eigen::MatrixXd& internal = history_.state.internal;
  if (internal.rows() != variables.size()) internal.resize(variables.size(), internal.cols());
  internal.col(place(column)) = variables;
}

void Recorder::make_room() {
  const Index size = std::min(block_, columns() - history_.handed_on);
  visit_arrays(history_, [&](auto& values) { resize(values, size); });
  // Residuals start at zero, since residuals() keeps the largest of the joints.
  ConstraintHistory& constraints = history_.constraints;
  for (VectorXd* part : {&constraints.position_m, &constraints.orientation_rad,
                         &constraints.velocity_m_s, &constraints.angular_velocity_rad_s})
    part->setZero();
  for (Index k = 0; k < size; ++k) history_.time_s[k] = time_s(history_.handed_on + k);
}

void Recorder::begin(Index column) {
  if (place(column) < history_.time_s.size()) return;
  sink_(history_);
  for (std::size_t k = 0; k < last_rotations_.size(); ++k)
    last_rotations_[k] = history_.markers[k].rotation.rightCols<1>();
  history_.handed_on = column;
  make_room();
}

void Recorder::marker(Index column, std::size_t index, const MarkerState& motion) {
  if (watched_[index])
    watch_.show(*watched_[index], motion.rotation, motion.angular_velocity_rad_s);
  MarkerHistory& marker = history_.markers[index];
  column = place(column);
  marker.position_m.col(column) = motion.position_m;
  marker.velocity_m_s.col(column) = motion.velocity_m_s;
  marker.angular_velocity_rad_s.col(column) = motion.angular_velocity_rad_s;
  marker.acceleration_m_s2.col(column) = motion.acceleration_m_s2;
  marker.angular_acceleration_rad_s2.col(column) = motion.angular_acceleration_rad_s2;
  // A rotation has two quaternions: take the one near the last.
  const Eigen::Quaterniond q(motion.rotation);
  Eigen::Vector4d rotation(q.w(), q.x(), q.y(), q.z());
  const double* const last =
      column > 0 ? &marker.rotation(0, column - 1) : last_rotations_[index].data();
  if (rotation.dot(Eigen::Map<const Eigen::Vector4d>(last)) < 0) rotation = -rotation;
  marker.rotation.col(column) = rotation;
}

void Recorder::joint(Index column, std::size_t index, const Reaction& world,
                     const Eigen::Matrix3d& R_i) {
  JointHistory& joint = history_.joints[index];
  column = place(column);
  joint.force_N.col(column) = R_i.transpose() * world.force_N;
  joint.moment_Nm.col(column) = R_i.transpose() * world.moment_Nm;
}

void Recorder::modal(Index column, std::size_t body, const VectorXd& a) {
  if (a.size() == 0) return;
  watch_.check_deformation(time_s(column), body, a);
  history_.modal[modal_of_body_[body]].coordinates.col(place(column)) = a;
}

void Recorder::energy(Index column, const Energies& stored, double dissipated_J, double work_J) {
  EnergyHistory& energy = history_.energy;
  column = place(column);
  energy.kinetic_J[column] = stored.kinetic_J;
  energy.gravitational_J[column] = stored.gravitational_J;
  energy.strain_J[column] = stored.strain_J;
  energy.dissipated_J[column] = dissipated_J;
  energy.work_J[column] = work_J;
}

void Recorder::conserve_energy(Index column) {
  EnergyHistory& energy = history_.energy;
  const Index k = place(column);
  const double stored_J = energy.kinetic_J[k] + energy.gravitational_J[k] + energy.strain_J[k];
  if (column == 0) first_energy_J_ = stored_J;
  energy.work_J[k] = stored_J - first_energy_J_;
}

void Recorder::look(Index column) {
  watch_.look(time_s(column));
  for (std::size_t k = 0; k < history_.angles.size(); ++k)
    history_.angles[k].angle_rad[place(column)] = watch_.angles().angle_rad(k);
  if (!keeps_states()) return;
  // The measured angles are the last rows.
  const auto measured = static_cast<Index>(history_.angles.size());
  for (Index k = 0; k < measured; ++k)
    history_.state.angles.col(place(column)).tail(measured)[k] =
        watch_.angles().angle_rad(static_cast<std::size_t>(k));
}

void Recorder::residuals(Index column, const Violation& position, const Violation& velocity) {
  const auto keep = [](double& largest, double value) { largest = std::max(largest, value); };
  ConstraintHistory& constraints = history_.constraints;
  column = place(column);
  keep(constraints.position_m[column], position.translation);
  keep(constraints.orientation_rad[column], position.rotation);
  keep(constraints.velocity_m_s[column], velocity.translation);
  keep(constraints.angular_velocity_rad_s[column], velocity.rotation);
  StepStatistics& statistics = history_.statistics;
  keep(statistics.max_position_residual, std::max(position.translation, position.rotation));
  keep(statistics.max_velocity_residual, std::max(velocity.translation, velocity.rotation));
}

void Recorder::undetermined(std::size_t joint, const Eigen::Array<bool, 6, 1>& components) {
  undetermined_[joint] = undetermined_[joint] || components;
}

void Recorder::mobility(int freedoms, std::vector<std::string> redundant,
                        std::vector<std::string> doubts) {
  history_.freedoms = freedoms;
  history_.redundant_constraints = std::move(redundant);
  history_.warnings = std::move(doubts);
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
  for (const std::string& warning : watch_.warnings()) history_.warnings.push_back(warning);
  return std::move(history_);
}

History Recorder::take_incomplete(Index column, const std::string& why) {
  history_.incomplete = why;
  visit_arrays(history_, [&](auto& values) { resize(values, place(column)); });
  return take();
}

}  // namespace flexneck::multibody
