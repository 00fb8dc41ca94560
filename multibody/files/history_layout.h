// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "multibody/analysis/linearisation.h"
#include "multibody/history/history.h"

namespace flexneck::multibody {

// Names and units of the datasets of a history, for its writer and its reader; private to them.

inline constexpr const char* kMarkers = "/markers";
inline constexpr const char* kJoints = "/joints";
inline constexpr const char* kModal = "/modal";
inline constexpr const char* kStates = "/state/bodies";
inline constexpr const char* kInternal = "/state/internal";  ///< m and rad
inline constexpr const char* kInertia = "inertia";           ///< in the group of a body's state
inline constexpr const char* kInertiaUnit = "kg, kg m, kg m^2";
inline constexpr const char* kAngles = "/state/angles";
inline constexpr const char* kAngleNames = "/state/angle_names";
inline constexpr const char* kChannels = "/channels";
inline constexpr const char* kEnergy = "/energy";
inline constexpr const char* kConstraints = "/constraints";
inline constexpr const char* kStatistics = "/statistics";
inline constexpr const char* kLinearisation = "/linearisation";
/// Attribute with the position of a group in the model's list: HDF5 itself lists groups by name.
inline constexpr const char* kIndex = "index";
inline constexpr const char* kUndetermined = "undetermined";
inline constexpr const char* kIncomplete = "incomplete";
inline constexpr const char* kFreedoms = "freedoms";
inline constexpr const char* kRedundant = "/statistics/redundant_constraints";
inline constexpr const char* kWarnings = "/statistics/warnings";
inline constexpr const char* kLimits = "/statistics/step_limits";
inline constexpr const char* kLimitedSteps = "/statistics/limited_steps";
inline constexpr const char* kModalUnit = "kg^(1/2) m";

/// Calls visit(name, vectors, unit) for the vectors of a marker with their datasets' names and
/// units.
template <class Markers, class Visit>
void visit_vectors(Markers& marker, const Visit& visit) {
  visit("position", marker.position_m, "m");
  visit("velocity", marker.velocity_m_s, "m/s");
  visit("acceleration", marker.acceleration_m_s2, "m/s^2");
  visit("rotation", marker.rotation, "1");
  visit("angular_velocity", marker.angular_velocity_rad_s, "rad/s");
  visit("angular_acceleration", marker.angular_acceleration_rad_s2, "rad/s^2");
}

template <class Joints, class Visit>
void visit_reactions(Joints& joint, const Visit& visit) {
  visit("force", joint.force_N, "N");
  visit("moment", joint.moment_Nm, "N m");
}

template <class Energies, class Visit>
void visit_energies(Energies& energy, const Visit& visit) {
  visit("kinetic", energy.kinetic_J);
  visit("gravitational", energy.gravitational_J);
  visit("strain", energy.strain_J);
  visit("dissipated", energy.dissipated_J);
  visit("work", energy.work_J);
}

template <class Constraints, class Visit>
void visit_constraints(Constraints& constraints, const Visit& visit) {
  visit("position", constraints.position_m, "m");
  visit("orientation", constraints.orientation_rad, "rad");
  visit("velocity", constraints.velocity_m_s, "m/s");
  visit("angular_velocity", constraints.angular_velocity_rad_s, "rad/s");
}

template <class Bodies, class Visit>
void visit_state(Bodies& body, const Visit& visit) {
  visit("position", body.position_m, "m");
  visit("rotation", body.rotation, "1");
  visit("velocity", body.velocity_m_s, "m/s");
  visit("angular_velocity", body.angular_velocity_rad_s, "rad/s");
  visit("modal", body.modal, kModalUnit);
  visit("modal_rate", body.modal_rate, "kg^(1/2) m/s");
}

inline std::string path_of(const std::string& group, const std::string& name) {
  return group + "/" + name;
}

struct ModeNumber {
  const char* name;
  double SystemMode::*member;
  const char* unit;
};
inline constexpr std::array<ModeNumber, 4> kModeNumbers = {
    {{"frequency", &SystemMode::frequency_Hz, "Hz"},
     {"damped_frequency", &SystemMode::damped_frequency_Hz, "Hz"},
     {"damping_ratio", &SystemMode::damping_ratio, "1"},
     {"growth_rate", &SystemMode::growth_rate_1_s, "1/s"}}};

struct ShapePart {
  const char* name;
  Eigen::Matrix3Xcd ModeShape::*member;
  const char* unit;
};
inline constexpr std::array<ShapePart, 2> kShapeParts = {
    {{"translation", &ModeShape::translation, "m"}, {"rotation", &ModeShape::rotation, "rad"}}};

}  // namespace flexneck::multibody
