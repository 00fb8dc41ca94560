// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "multibody/forces/force_check.h"
#include "multibody/forces/internal_variables.h"
#include "multibody/forces/resistance.h"
#include "multibody/joints/joint.h"
#include "multibody/numerics/counted_angle.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::multibody {

/// Distance (m) or angle (rad) below which a direction is not defined and no load acts.
inline constexpr double kNoDirection = 1e-12;

/// A marker's motion, world axes, SI.
struct MarkerKinematics {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< marker axes to world
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
};

/// Input of a force element's act(); an element with a single marker has it both as i and as j.
struct ForceInput {
  const MarkerKinematics& i;
  const MarkerKinematics& j;
  const std::vector<Joint>& joints;  ///< the model's joints
  /// The angle of each joint that has one, as last counted.
  const std::vector<CountedAngle>& angles;
  double time_s;
  InternalVariables internal = {};  ///< used by a RelaxingForce
};

/// The load of a force element, world axes, on j's body at j's origin. On i's body, if i is another
/// marker, the opposite acts at the same point.
struct ForceLoad {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
  LawPiece piece;  ///< set by a PiecewiseForce; initially as in the last evaluation
};

/// Sums over force elements. The loads give the bodies the power work_W - d(stored_J)/dt - lost_W.
struct ForceEnergies {
  double stored_J = 0;  ///< potential energy of the elements
  double lost_W = 0;    ///< dissipated power
  double work_W = 0;    ///< power from outside the model
  /// Potential of the loads as if they were constant, where it exists: equilibria are minima of the
  /// sum of it and the stored energy.
  double potential_J = 0;
};

/// A kind of force element: an aggregate, and all that the rest of the program knows of it.
/// - Kind::kName: its name in files and messages; name: the element's own
/// - check(who, sites): throws InputError, which begins with `who`, if the element is invalid
/// - markers(joints): indices of the markers that it loads, a std::array of one, or of i and j
/// - act(input, load, sums): sets the load, which is zero, and adds to the sums; allocates nothing
template <class Kind>
concept ForceElement = requires(const Kind& element, const std::string& who,
                                const ForceSites& sites, const std::vector<Joint>& joints,
                                const ForceInput& input, ForceLoad& load, ForceEnergies& sums) {
  { Kind::kName } -> std::convertible_to<std::string_view>;
  { element.name } -> std::convertible_to<const std::string&>;
  { element.check(who, sites) } -> std::same_as<void>;
  { element.markers(joints).front() } -> std::convertible_to<std::size_t>;
  { element.act(input, load, sums) } -> std::same_as<void>;
};

/// A force whose load follows a table of time: steps end at the table's rows.
template <class Kind>
concept TimedForce = requires(const Kind& element) {
  { element.load_over_time() } -> std::same_as<const TimeTable&>;
};

/// A force whose load has a direction, a unit vector, which is fixed in the world if
/// keeps_direction().
template <class Kind>
concept WorldForce = requires(const Kind& element) {
  { element.direction } -> std::convertible_to<const Eigen::Vector3d&>;
  { element.keeps_direction() } -> std::same_as<bool>;
};

/// A force whose load has kinks along a motion, and which reports its present smooth piece.
template <class Kind>
concept PiecewiseForce = requires {
  requires Kind::kHasKinks;
};

/// A force with dashpots of its own, with a block of internal variables (InternalBlock) for each
/// branch.
template <class Kind>
concept RelaxingForce = requires(const Kind& element) {
  { element.branch_count() } -> std::convertible_to<std::size_t>;
  { element.relaxation_time_s(std::size_t{}) } -> std::convertible_to<double>;
  { element.branch_size() } -> std::convertible_to<Eigen::Index>;
};

/// A force that resists every relative motion of its two bodies, of marker_i and marker_j, so that
/// one carries the other.
template <class Kind>
concept HoldingForce = requires {
  requires Kind::kHolds;
};

/// A force whose loads follow from the rotation vector from marker_i to marker_j, which jumps at
/// half a turn, if it resists rotation at all.
template <class Kind>
concept TurnedForce = requires(const Kind& element) {
  { element.resists_turning() } -> std::same_as<bool>;
};

/// A force whose kinks are all of one sort, kKink.
template <class Kind>
concept NamedKink = requires {
  { Kind::kKink } -> std::convertible_to<std::string_view>;
};

/// Name of an element in messages, as "spring 'rope'".
template <ForceElement Kind>
std::string title(const Kind& element) {
  return std::string(Kind::kName) + " '" + element.name + "'";
}

}  // namespace flexneck::multibody
