// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fe_modal/body/modal_body.h"
#include "multibody/forces/force_kinds.h"
#include "multibody/joints/joint.h"
#include "multibody/model/slit_gaps.h"
#include "multibody/numerics/prescribed_coordinate.h"
#include "multibody/numerics/smooth_motion.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::multibody {

/// Position of a frame's origin and its rotation to the world: v_World = rotation * v_Frame.
struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

struct RigidBody {
  double mass_kg = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< body frame
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre, body axes
};

struct DeformableBody {
  fe_modal::ModalBody modes;      ///< the chosen modes only
  Eigen::VectorXd damping_ratio;  ///< zeta of each mode
  /// Modal coordinates of the unloaded body, a permanent set, kg^(1/2) m; empty for none.
  Eigen::VectorXd offset = {};
  /// True if loads stiffen and soften it, by the geometric stiffness in its modes file
  /// (equations.md section 3a). Otherwise it is linear in its own frame.
  bool stress_stiffening = false;
  /// Modal coordinates and rates at the start, kg^(1/2) m and kg^(1/2) m/s; empty: `offset`, at
  /// rest.
  Eigen::VectorXd initial_modal = {};
  Eigen::VectorXd initial_modal_rate = {};
  /// Gaps of slits that open and close; the modes are those with all slits closed.
  SlitGaps gaps = {};
};

/// Rotation of a prescribed body about an axis through a point, which translates with the body. The
/// angle is the sum of an initial rate, a table and a function of time; by default zero.
struct PrescribedTurn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();    ///< unit vector in the world
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< world, at time zero
  double initial_rate_rad_s = 0;
  TimeTable acceleration_rad_s2;  ///< zero outside
  SmoothMotion motion = {};       ///< in rad where SmoothMotion has m
  HeldInput input = {};
};

/// A body that translates and rotates in a prescribed way, whatever loads act on it. Its travel is
/// the sum of an initial velocity, a table and a function of time. By default it is the ground.
struct PrescribedBody {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector in the world
  double initial_velocity_m_s = 0;                       ///< along `direction`
  TimeTable acceleration_m_s2;                           ///< along `direction`; zero outside
  SmoothMotion motion = {};                              ///< along `direction`
  PrescribedTurn turn = {};
  HeldInput input = {};  ///< along `direction`
};

struct Body {
  std::string name;
  std::variant<RigidBody, DeformableBody, PrescribedBody> kind;
  Pose initial_pose;
  Eigen::Vector3d initial_velocity_m_s = Eigen::Vector3d::Zero();            ///< origin, world
  Eigen::Vector3d initial_angular_velocity_rad_s = Eigen::Vector3d::Zero();  ///< body axes
  /// The velocities are not given: if joints and motors demand others, they become the nearest that
  /// fit.
  bool velocities_are_open = false;
};

/// A frame on a body: on a rigid or prescribed body at any position, on a deformable one at an
/// interface, whose motion it follows (finite rotation).
struct Marker {
  std::string name;
  std::size_t body = 0;
  std::string interface;                                 ///< empty unless on a deformable body
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< body frame; unused at an interface
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< marker axes to body axes
};

/// The angle by which a marker is rotated about an axis, with turns counted from the start of a
/// run.
struct MeasuredAngle {
  std::string name;
  std::size_t marker = 0;
  std::optional<std::size_t> relative_to;           ///< another marker; the world if empty
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< unit vector in the axes of the other
  double start_rad = 0;  ///< selects the turn in which it starts: within half a turn of this
};

/// Start time of a run, and the initial state of its force elements and energy balance; by default
/// time zero, after a long time at rest. Bodies start in their given states.
struct RunStart {
  double time_s = 0;
  Eigen::VectorXd internal = {};  ///< variables of the branches of sections; empty: relaxed
  double dissipated_J = 0;        ///< energy dissipated until then
  double work_J = 0;              ///< work done until then
};

struct Model {
  std::vector<Body> bodies;
  std::vector<Marker> markers;
  std::vector<Joint> joints;
  std::vector<MeasuredAngle> angles;
  Forces forces;                                           ///< force elements of all kinds
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero();  ///< world
  RunStart start = {};

  /// The index of a body, marker or joint.
  /// @throws InputError if there is none of that name; the message lists the existing names.
  std::size_t body_index(const std::string& name) const;
  std::size_t marker_index(const std::string& name) const;
  std::size_t joint_index(const std::string& name) const;
};

/// Modal coordinates and rates of a deformable body at the start, (m).
Eigen::VectorXd initial_modal(const DeformableBody& body);
Eigen::VectorXd initial_modal_rate(const DeformableBody& body);

/// The mass of an undeformed body that is not prescribed, its first moments and its moments of
/// inertia (xx, yy, zz, xy, xz, yz) about the origin, kg, kg m, kg m^2.
Eigen::VectorXd inertia_of(const Body& body);

/// Checks names, indices, masses and inertias (symmetric, positive, triangle inequality), damping,
/// unit vectors.
/// @throws InputError naming the body, marker, joint or force.
void check(const Model& model);

}  // namespace flexneck::multibody
