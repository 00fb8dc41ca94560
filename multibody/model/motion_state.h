// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::multibody {

/// Motion of a marker, world axes.
struct MarkerState {
  Eigen::Vector3d position_m;
  Eigen::Vector3d velocity_m_s;
  Eigen::Vector3d acceleration_m_s2;  ///< kinematic
  Eigen::Matrix3d rotation;           ///< marker axes to world
  Eigen::Vector3d angular_velocity_rad_s;
  Eigen::Vector3d angular_acceleration_rad_s2;
};

/// Motion of a body's frame: x'' and x' of its origin in world axes, w and its rate in its own.
struct BodyState {
  Eigen::Vector3d position_m;
  Eigen::Matrix3d rotation;  ///< body axes to world
  Eigen::VectorXd modal;
  Eigen::VectorXd velocities;     ///< [x'; w; a']
  Eigen::VectorXd accelerations;  ///< [x''; w'; a'']
};

/// Force and moment about the origin of marker j that i exerts on j, world axes (equations.md
/// section 4).
struct Reaction {
  Eigen::Vector3d force_N;
  Eigen::Vector3d moment_Nm;
};

/// Energies of all bodies that are not prescribed.
struct Energies {
  double kinetic_J = 0;
  double gravitational_J = 0;
  double strain_J = 0;
  /// Their kinetic energy if they were carried along by the fastest prescribed body, rotating about
  /// any axis.
  double carried_J = 0;
};

/// Kinetic energy of a body that its base carries along, rotating about any axis.
/// @param v_m_s, w_rad_s  velocity of the base at the body's origin, and angular velocity
/// @param trace_kg_m2  trace of the body's inertia about its origin; the moment of inertia about
/// any axis of a body is at most half of it
inline double carried_energy_J(const Eigen::Vector3d& v_m_s, const Eigen::Vector3d& w_rad_s,
                               double mass_kg, double trace_kg_m2) {
  return mass_kg / 2 * v_m_s.squaredNorm() + trace_kg_m2 / 4 * w_rad_s.squaredNorm();
}

}  // namespace flexneck::multibody
