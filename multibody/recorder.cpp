// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/recorder.h"

#include <Eigen/Geometry>

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::VectorXd;

Recorder::Recorder(const Model& model, const VectorXd& times_s) {
  const Index n = times_s.size();
  history_.time_s = times_s;
  for (const Marker& marker : model.markers) {
    history_.markers.push_back({marker.name, Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n),
                                Eigen::Matrix3Xd(3, n), Eigen::Matrix4Xd(4, n),
                                Eigen::Matrix3Xd(3, n)});
  }
  for (const Joint& joint : model.joints)
    history_.joints.push_back({joint.name, Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)});
  for (const Body& body : model.bodies) {
    const auto* deformable = std::get_if<DeformableBody>(&body.kind);
    if (deformable == nullptr) continue;
    ModalHistory modal{body.name, {}, Eigen::MatrixXd(deformable->modes.mode_count(), n)};
    for (const fe_modal::ModeRecord& mode : deformable->modes.modes)
      modal.modes.push_back(mode.name);
    history_.modal.push_back(std::move(modal));
  }
  EnergyHistory& energy = history_.energy;
  for (VectorXd* part : {&energy.kinetic_J, &energy.gravitational_J, &energy.strain_J,
                         &energy.dissipated_J, &energy.work_J}) {
    part->setZero(n);
  }
}

void Recorder::record(Index column, EquationsOfMotion& equations, const VectorXd& state) {
  const System& system = equations.system();
  equations.update_idle_markers(state.segment(system.position_count, system.velocity_count));
  for (std::size_t k = 0; k < history_.markers.size(); ++k) record_marker(column, k, equations);
  for (std::size_t k = 0; k < history_.joints.size(); ++k) {
    const Reaction world = equations.joint_reaction(k);
    const Eigen::Matrix3d& R_i = equations.marker(system.joints[k].marker_i).R;
    history_.joints[k].force_N.col(column) = R_i.transpose() * world.force_N;
    history_.joints[k].moment_Nm.col(column) = R_i.transpose() * world.moment_Nm;
  }
  std::size_t deformable = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    if (system.bodies[b].constants.mode_count() > 0)
      history_.modal[deformable++].coordinates.col(column) = equations.body(b).a;
  record_energies(column, equations, state);
}

void Recorder::record_marker(Index column, std::size_t index, const EquationsOfMotion& equations) {
  const System& system = equations.system();
  const NodeKinematics& motion = equations.marker(index);
  MarkerHistory& marker = history_.markers[index];
  marker.position_m.col(column) = motion.p;
  marker.velocity_m_s.col(column) = motion.pd;
  marker.angular_velocity_rad_s.col(column) = motion.Om;
  // pdd = P Vdot + gp.
  marker.acceleration_m_s2.col(column) = motion.gp;
  const std::size_t b = system.markers[index].free_body;
  if (b != JointPlace::kNoBody) {
    const FreeBody& body = system.bodies[b];
    marker.acceleration_m_s2.col(column) +=
        motion.P * equations.accelerations().segment(body.velocity, motion.P.cols());
  }
  // Of the two quaternions of a rotation, the one near the last.
  const Eigen::Quaterniond q(motion.R);
  Eigen::Vector4d rotation(q.w(), q.x(), q.y(), q.z());
  if (column > 0 && rotation.dot(marker.rotation.col(column - 1)) < 0) rotation = -rotation;
  marker.rotation.col(column) = rotation;
}

void Recorder::record_energies(Index column, const EquationsOfMotion& equations,
                               const VectorXd& state) {
  const System& system = equations.system();
  EnergyHistory& energy = history_.energy;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const FreeBody& body = system.bodies[b];
    const BodyTerms& terms = equations.body(b);
    const auto V =
        state.segment(system.position_count + body.velocity, body.constants.velocity_count());
    energy.kinetic_J[column] += kinetic_energy_J(terms, V);
    energy.gravitational_J[column] +=
        gravitational_energy_J(body.constants, system.gravity_m_s2, terms);
    energy.strain_J[column] += strain_energy_J(body.constants, terms);
  }
  const Index quadratures = system.position_count + system.velocity_count;
  energy.dissipated_J[column] = state[quadratures];
  energy.work_J[column] = state[quadratures + 1];
}

}  // namespace flexneck::multibody
