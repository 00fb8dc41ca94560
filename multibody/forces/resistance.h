// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>

#include "multibody/forces/load_curve.h"

namespace flexneck::multibody {

/// One direction of a joint's or spring's resistance, after the joint cards of the ATB model: a
/// curve, and beyond a stop a second one added to it.
struct ResistanceSide {
  LoadCurve curve;                                        ///< over the deflection
  double stop = std::numeric_limits<double>::infinity();  ///< deflection, m or rad
  LoadCurve beyond_stop;                                  ///< over the deflection less the stop
  /// Ratio of the unloading to the loading curve, in [0, 1]: 1 returns all energy.
  double unloading_ratio = 1;

  double load(double x) const;
  double energy(double x) const;
  /// The piece at x. Its number counts the passed kinks, rows of tables and the stop; 0 before all
  /// of them.
  CurvePiece piece(double x) const;
};

/// Resistance against a deflection x of either sign and its rate: different curves in the two
/// directions, viscous damping and Coulomb friction. The parts that depend on the sign of the rate,
/// friction and hysteresis, grow linearly up to `full_rate`, as in ATB: the law is continuous.
struct Resistance {
  ResistanceSide positive, negative;
  double damping = 0;    ///< N s/m or N m s/rad
  double friction = 0;   ///< N or N m
  double full_rate = 0;  ///< m/s or rad/s; positive where there is friction or hysteresis
  /// It only pulls: no load at x <= 0, never a push.
  bool tension_only = false;
};

/// Checks a resistance.
/// @throws InputError, which begins with `who`, for negative numbers, a ratio out of its interval,
/// no full_rate where there is friction or hysteresis.
void check_resistance(const std::string& who, const Resistance& resistance);

/// Load of a resistance at a deflection x and rate v, against growing x, and the parts of its power
/// load * v: stored, d(stored)/dt, and dissipated.
struct ResistanceLoad {
  double load = 0;
  double stored_J = 0;
  double lost_W = 0;
};
ResistanceLoad evaluate(const Resistance& resistance, double x, double v);

/// A coordinate along which a law has kinks, and the nearest of them on both sides.
struct KinksAround {
  double at = 0;  ///< m, rad, or per s
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Smooth piece of its law on which a resistance is: where one of these numbers changes, the load
/// has a kink. The coordinates give the distance to it; without kinks if a law does not know them.
struct LawPiece {
  int deflection = 0;  ///< row of a table, beyond a stop, slack
  int rate = 0;  ///< friction and hysteresis complete: negative (-1), positive (1), neither (0)
  KinksAround of_deflection = {};
  KinksAround of_rate = {};
};
LawPiece piece_of(const Resistance& resistance, double x, double v);

}  // namespace flexneck::multibody
