// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// One mode of the linearised system.
struct SystemMode {
  double frequency_Hz = 0;  ///< |lambda| / 2 pi, the undamped frequency
  double damped_frequency_Hz = 0;
  double damping_ratio = 0;
  double growth_rate_1_s = 0;  ///< of an unstable one: its largest Re lambda; of others zero

  /// Of a model that was linearised where a load has a kink, so that its stiffness is the mean of
  /// both sides: which; else empty.
  std::string kink = {};

  bool is_unstable() const { return growth_rate_1_s > 0; }
};

/// Modes of xi'' + damping xi' + stiffness xi = 0, ascending in frequency: from each conjugate pair
/// of eigenvalues lambda, f = |lambda| / 2 pi and zeta = -Re lambda / |lambda|. Real eigenvalues,
/// those of overdamped motion, are paired by their shapes: with l1 and l2 those of a pair,
/// (2 pi f)^2 = l1 l2 and zeta = -(l1 + l2) / (2 sqrt(l1 l2)), at least 1 if both decay, damped
/// frequency zero. A motion without restoring force has frequency and damping ratio zero, and so
/// has one that moves away, with eigenvalues of both signs. An unstable motion has a growth rate.
std::vector<SystemMode> modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping);

/// A of xi'' + damping xi' + stiffness xi = 0 in y = [xi; xi'].
Eigen::MatrixXd second_order(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping);

/// A mode and its eigenvector in the coordinates xi; of an overdamped one that of the slower
/// motion, of one that moves away that of the growing motion, of a motion without restoring force
/// empty.
struct Eigenmode {
  SystemMode mode;
  Eigen::VectorXcd shape;
};

/// The modes of y' = A y, y = [positions; rates; internal], ascending in frequency, as modes_of().
/// With internal variables, which relax, overdamped motion cannot be told from relaxation: only
/// motions that swing or grow are modes then.
/// @param positions  how many; the rest are rates. Positions may be more than rates by what
///                   normalised quaternions have too many.
std::vector<Eigenmode> eigenmodes_of(const Eigen::MatrixXd& A, Eigen::Index positions,
                                     Eigen::Index internal = 0);

/// A mode of a whole model: how its markers swing, x(t) = Re(amplitude exp(i omega t)), scaled so
/// that the largest displacement of a marker is a metre (if none is displaced, the largest
/// rotation a radian) and real. Zero for a motion without restoring force.
struct ModeShape {
  SystemMode mode;
  Eigen::Matrix3Xcd translation;  ///< a column for each marker, world axes
  Eigen::Matrix3Xcd rotation;     ///< rad, likewise
};

/// About what a model is linearised.
enum class LinearisedAt {
  /// The free bodies at rest against the prescribed ones: the static equilibrium, or where
  /// prescribed
  /// bodies turn at time zero, steady rotation with them (steady_rotation.h). Motions are then seen
  /// from the bodies that turn, in axes that are the world's at time zero.
  equilibrium,
  given  ///< what the bodies are given, velocities and the drive at time zero included
};

/// Small motions about a state. About a given one, which need not be an equilibrium, they are those
/// of the coefficients as they are there: exact where they stay, as on a hub that turns evenly, but
/// without the deformation that spin causes.
/// @throws as simulate_from_equilibrium() or rotating_positions(); InputError if a model that is
/// given in motion closes a loop.
std::vector<ModeShape> linearise(const Model& model, LinearisedAt at);

/// Small motions about that equilibrium, or about steady rotation where prescribed bodies turn (see
/// LinearisedAt), ascending in frequency. An overdamped mode has a damping ratio of one or more and
/// the damped frequency zero; a motion without restoring force has frequency zero; of models with
/// sections that relax neither is listed. One that grows is unstable: with a frequency it swings,
/// with frequency zero it moves away.
/// @throws as linearise().
std::vector<SystemMode> system_modes(const Model& model);

}  // namespace flexneck::multibody
