// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/forces_check.h"

#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/joints/joint_kinds.h"

namespace flexneck::multibody {
namespace {

constexpr double kSlack = 1e-9;

[[noreturn]] void refuse(const std::string& who, const std::string& problem) {
  throw InputError(who + ": " + problem);
}

void check_marker(const std::string& who, std::size_t marker, const Model& model) {
  if (marker < model.markers.size()) return;
  refuse(who, "there is no marker of index " + std::to_string(marker) + ": there are " +
                  std::to_string(model.markers.size()));
}

void check_direction(const std::string& who, const Eigen::Vector3d& direction) {
  if (std::abs(direction.norm() - 1) <= kSlack) return;
  refuse(who,
         "direction must be a unit vector, but its length is " + std::to_string(direction.norm()));
}

void check_pair(const std::string& who, std::size_t i, std::size_t j, const Model& model) {
  check_marker(who, i, model);
  check_marker(who, j, model);
  if (model.markers[i].body == model.markers[j].body)
    refuse(who, "both markers are on body '" + model.bodies[model.markers[i].body].name +
                    "'; it needs two bodies");
}

void check_not_negative(const std::string& who, const std::string& what, double value) {
  if (!(value >= 0 && std::isfinite(value)))
    refuse(who, what + " must not be negative, but is " + std::to_string(value));
}

void check_resistance(const std::string& who, const Resistance& resistance) {
  check_not_negative(who, "damping", resistance.damping);
  check_not_negative(who, "friction", resistance.friction);
  check_not_negative(who, "the rate of full friction", resistance.full_rate);
  bool needs_rate = resistance.friction > 0;
  for (const ResistanceSide& side : {resistance.positive, resistance.negative}) {
    if (!(side.stop >= 0)) refuse(who, "a stop must not be negative");
    if (!(side.unloading_ratio >= 0 && side.unloading_ratio <= 1))
      refuse(who, "the ratio of unloading to loading must be from 0 to 1, but is " +
                      std::to_string(side.unloading_ratio));
    needs_rate = needs_rate || side.unloading_ratio < 1;
  }
  if (needs_rate && !(resistance.full_rate > 0))
    refuse(who, "friction and hysteresis need the rate at which they are complete (full_rate)");
}

/// Symmetric within rounding, and no negative eigenvalue: it must not feed energy.
void check_matrix(const std::string& who, const std::string& what,
                  const Eigen::Matrix<double, 6, 6>& matrix) {
  if (!matrix.allFinite()) refuse(who, what + " is not finite");
  const double size = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > kSlack * size)
    refuse(who, what + " must be symmetric");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(matrix,
                                                                         Eigen::EigenvaluesOnly);
  if (eigen.eigenvalues()[0] < -kSlack * size)
    refuse(who, what + " must not have a negative eigenvalue, but has " +
                    std::to_string(eigen.eigenvalues()[0]));
}

void check_coordinate(const std::string& who, const JointResistance& resistance,
                      const Joint& joint) {
  const auto demand = [&](JointCoordinate coordinate, bool JointKind::*has, const char* name) {
    if (resistance.coordinate != coordinate || joint.kind->*has) return;
    std::string kinds;
    for (const JointKind* const kind : kJointKinds)
      if (kind->*has) kinds += (kinds.empty() ? "" : ", ") + std::string(kind->name);
    refuse(who, "joint '" + joint.name + "' is " + std::string(joint.kind->name) + " and has no " +
                    name + "; the kinds that have one are: " + kinds);
  };
  demand(JointCoordinate::distance, &JointKind::has_distance, "distance");
  demand(JointCoordinate::angle, &JointKind::has_angle, "angle");
}

}  // namespace

void check_forces(const Model& model) {
  check_names(names_of(model.forces), "force");
  check_names(names_of(model.torques), "torque");
  check_names(names_of(model.springs), "spring");
  check_names(names_of(model.bushings), "bushing");
  check_names(names_of(model.resistances), "resistance");
  for (const PointForce& force : model.forces) {
    const std::string who = "force '" + force.name + "'";
    check_marker(who, force.marker, model);
    check_direction(who, force.direction);
  }
  for (const Torque& torque : model.torques) {
    const std::string who = "torque '" + torque.name + "'";
    check_marker(who, torque.marker, model);
    check_direction(who, torque.direction);
  }
  for (const MarkerSpring& spring : model.springs) {
    const std::string who = "spring '" + spring.name + "'";
    check_pair(who, spring.marker_i, spring.marker_j, model);
    check_not_negative(who, "the free length", spring.free_length_m);
    check_resistance(who, spring.resistance);
  }
  for (const Bushing& bushing : model.bushings) {
    const std::string who = "bushing '" + bushing.name + "'";
    check_pair(who, bushing.marker_i, bushing.marker_j, model);
    check_matrix(who, "stiffness", bushing.stiffness);
    check_matrix(who, "damping", bushing.damping);
  }
  for (const JointResistance& resistance : model.resistances) {
    const std::string who = "resistance '" + resistance.name + "'";
    if (resistance.joint >= model.joints.size())
      refuse(who, "there is no joint of index " + std::to_string(resistance.joint) +
                      ": there are " + std::to_string(model.joints.size()));
    check_coordinate(who, resistance, model.joints[resistance.joint]);
    check_resistance(who, resistance.resistance);
  }
}

}  // namespace flexneck::multibody
