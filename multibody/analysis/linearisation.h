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
  double growth_rate_1_s = 0;  ///< largest Re lambda if unstable, else zero

  /// The load with a kink at the state of linearisation, where the stiffness is the mean of both
  /// sides; empty if there is none.
  std::string kink = {};

  bool is_unstable() const { return growth_rate_1_s > 0; }
};

/// Modes of xi'' + damping xi' + stiffness xi = 0, ascending in frequency: from each conjugate pair
/// of eigenvalues lambda, f = |lambda| / 2 pi and zeta = -Re lambda / |lambda|. Real eigenvalues,
/// those of overdamped motion, are paired by their shapes: with l1 and l2 those of a pair, (2 pi
/// f)^2 = l1 l2 and zeta = -(l1 + l2) / (2 sqrt(l1 l2)), at least 1 if both decay, damped frequency
/// zero. A motion without restoring force has frequency and damping ratio zero, and so has a
/// diverging motion, with eigenvalues of both signs. An unstable motion has a growth rate.
std::vector<SystemMode> modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping);

/// System matrix A of xi'' + damping xi' + stiffness xi = 0 in y = [xi; xi'].
Eigen::MatrixXd second_order(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping);

/// A mode and its eigenvector in the coordinates xi: that of the slower motion if overdamped, that
/// of the growing motion if diverging, empty without restoring force.
struct Eigenmode {
  SystemMode mode;
  Eigen::VectorXcd shape;
};

/// Modes of y' = A y, y = [positions; rates; internal], ascending in frequency, as modes_of(). With
/// internal variables, which relax, overdamped motion cannot be distinguished from relaxation: only
/// oscillating or growing motions are then modes.
/// @param positions  their number; the rest are rates. There may be more positions than rates, by
/// one for each normalised quaternion.
std::vector<Eigenmode> eigenmodes_of(const Eigen::MatrixXd& A, Eigen::Index positions,
                                     Eigen::Index internal = 0);

/// A mode of a whole model as the oscillation of its markers, x(t) = Re(amplitude exp(i omega t)),
/// scaled so that the largest displacement of a marker is one metre (if there is none, the largest
/// rotation one radian) and real. Zero for a motion without restoring force.
struct ModeShape {
  SystemMode mode;
  Eigen::Matrix3Xcd translation;  ///< a column for each marker, world axes
  Eigen::Matrix3Xcd rotation;     ///< rad, world axes
};

/// State about which a model is linearised.
enum class LinearisedAt {
  /// Free bodies at rest relative to the prescribed ones: the static equilibrium or, if prescribed
  /// bodies rotate at time zero, steady rotation with them (steady_rotation.h). Motions are then
  /// relative to the rotating frame, in axes that are the world's at time zero.
  equilibrium,
  given  ///< the bodies' initial state, velocities and the drive at time zero included
};

/// Small motions about a state. If the state is given and not an equilibrium, they are those of the
/// coefficients frozen there: exact if these are constant, as on a hub in steady rotation, but
/// without the deformation that rotation causes.
/// @throws as simulate_from_equilibrium() or rotating_positions(); InputError if a model with a
/// closed loop is given in motion.
std::vector<ModeShape> linearise(const Model& model, LinearisedAt at);

/// Small motions about the static equilibrium, or about steady rotation if prescribed bodies rotate
/// (see LinearisedAt), ascending in frequency. An overdamped mode has a damping ratio of one or
/// more and the damped frequency zero; a motion without restoring force has frequency zero; neither
/// is listed for models with sections that relax. A growing mode is unstable: it oscillates if it
/// has a frequency, and diverges if the frequency is zero.
/// @throws as linearise().
std::vector<SystemMode> system_modes(const Model& model);

}  // namespace flexneck::multibody
