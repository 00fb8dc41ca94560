// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/axis_system.h"

namespace flexneck::pipeline {

/// Content of [[modes.coupling]]: nodes that follow a point as a rigid body.
struct CouplingSection {
  std::string name;
  std::string set;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  std::array<bool, 3> directions = {true, true, true};
};

/// Content of [[modes.support]]: fixes a node set, or a coupling's point, in some directions.
struct SupportSection {
  std::string at;
  std::array<bool, 3> directions{};
  std::array<bool, 3> turns{};  ///< rotations of a coupling
  mesher::AxisSystem axes;
};

/// A degree of freedom: a direction, or a rotation about it.
struct ConnectionTerm {
  std::string at;  ///< a node set of one node, or a coupling
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  bool is_rotation = false;
};

/// Content of [[modes.equation]]: the sum of the terms is zero.
struct EquationSection {
  std::string name;
  std::vector<ConnectionTerm> terms;
};

/// Content of [[modes.spring]]: to ground, or between two points.
struct SpringSection {
  std::string name;
  std::vector<std::string> between;
  std::optional<Eigen::Vector3d> direction;  ///< none: along the line between the two points
  bool is_rotation = false;
  double stiffness = 0;  ///< N/m, or N m/rad
};

/// Content of [[modes.point_mass]].
struct PointMassSection {
  std::string name;
  std::string at;
  double mass_kg = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< relative to that point
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre
};

/// Supports, couplings and loads of [modes], besides the sets that are fixed.
struct ModesConnections {
  std::vector<CouplingSection> couplings;
  std::vector<SupportSection> supports;
  std::vector<EquationSection> equations;
  std::vector<SpringSection> springs;
  std::vector<PointMassSection> masses;
};

}  // namespace flexneck::pipeline
