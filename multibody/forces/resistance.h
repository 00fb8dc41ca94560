// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>

#include "multibody/forces/load_curve.h"

namespace flexneck::multibody {

/// One direction of a joint's or spring's resistance, after the ATB model's joint cards: a curve,
/// and beyond a stop another on top of it.
struct ResistanceSide {
  LoadCurve curve;                                        ///< over the deflection
  double stop = std::numeric_limits<double>::infinity();  ///< deflection, m or rad
  LoadCurve beyond_stop;                                  ///< over what exceeds the stop
  /// Load of unloading over that of loading, in [0, 1]: 1 gives all energy back.
  double unloading_ratio = 1;

  double load(double x) const;
  double energy(double x) const;
  /// Its number counts what x has passed, rows of tables and the stop; 0 before all of them.
  CurvePiece piece(double x) const;
};

/// Resistance against a deflection x of either sign and its rate: curves different in the two
/// directions, viscous damping and Coulomb friction. What depends on the sign of the rate, friction
/// and hysteresis, grows linearly up to `full_rate`, as in ATB: the law is continuous.
struct Resistance {
  ResistanceSide positive, negative;
  double damping = 0;    ///< N s/m or N m s/rad
  double friction = 0;   ///< N or N m
  double full_rate = 0;  ///< m/s or rad/s; positive where there is friction or hysteresis
  /// Pulls only: nothing at x <= 0, never a push.
  bool tension_only = false;
};

/// @throws InputError, which begins with `who`: what is negative, a ratio out of its interval, no
///         full_rate where there is friction or hysteresis.
void check_resistance(const std::string& who, const Resistance& resistance);

/// A resistance at a deflection x and rate v: the load against growing x, and of its power load * v
/// what is stored, d(stored)/dt, and what is lost.
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

/// Which smooth piece of its law a resistance is on: where one of these numbers changes, the load
/// has a kink. Coordinates tell how far that is; without kinks where a law does not say.
struct LawPiece {
  int deflection = 0;  ///< which rows of a table, beyond which stop, slack or not
  int rate = 0;        ///< friction and hysteresis complete one way (-1), the other (1) or not yet
  KinksAround of_deflection = {};
  KinksAround of_rate = {};
};
LawPiece piece_of(const Resistance& resistance, double x, double v);

}  // namespace flexneck::multibody
