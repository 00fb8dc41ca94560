// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/resistance.h"

#include <algorithm>

#include "geometry/foundation/output_file.h"
#include "multibody/forces/force_check.h"

namespace flexneck::multibody {

double ResistanceSide::load(double x) const {
  return curve.value(x) + (x > stop ? beyond_stop.value(x - stop) : 0);
}

double ResistanceSide::energy(double x) const {
  return curve.energy(x) + (x > stop ? beyond_stop.energy(x - stop) : 0);
}

CurvePiece ResistanceSide::piece(double x) const {
  // As x grows, rows of both curves are passed one by one.
  CurvePiece found = curve.piece(x);
  if (x > stop) {
    const CurvePiece beyond = beyond_stop.piece(x - stop);
    return {found.number + 1 + beyond.number, std::max(found.low, stop + beyond.low),
            std::min(found.high, stop + beyond.high)};
  }
  found.high = std::min(found.high, stop);
  return found;
}

void check_resistance(const std::string& who, const Resistance& resistance) {
  check_not_negative(who, "damping", resistance.damping);
  check_not_negative(who, "friction", resistance.friction);
  check_not_negative(who, "the rate of full friction", resistance.full_rate);
  bool needs_rate = resistance.friction > 0;
  for (const ResistanceSide& side : {resistance.positive, resistance.negative}) {
    if (!(side.stop >= 0)) refuse_force(who, "a stop must not be negative");
    if (!(side.unloading_ratio >= 0 && side.unloading_ratio <= 1))
      refuse_force(who, "the ratio of unloading to loading must be from 0 to 1, but is " +
                            exact_text(side.unloading_ratio));
    needs_rate = needs_rate || side.unloading_ratio < 1;
  }
  if (needs_rate && !(resistance.full_rate > 0))
    refuse_force(
        who,
        "friction and hysteresis need full_rate, the rate at which they reach their full value");
}

namespace {

bool depends_on_direction(const Resistance& resistance) {
  return resistance.full_rate > 0 &&
         (resistance.friction > 0 || resistance.positive.unloading_ratio < 1 ||
          resistance.negative.unloading_ratio < 1);
}

bool is_smooth_at_zero(const Resistance& resistance) {
  const ResistanceSide& a = resistance.positive;
  const ResistanceSide& b = resistance.negative;
  return a.stop > 0 && b.stop > 0 && a.unloading_ratio == 1 && b.unloading_ratio == 1 &&
         a.curve.continues(b.curve);
}

}  // namespace

LawPiece piece_of(const Resistance& resistance, double x, double v) {
  constexpr int kSlack = -1;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LawPiece piece;
  if (depends_on_direction(resistance)) {
    const double full = resistance.full_rate;
    piece.rate = v <= -full ? -1 : v >= full ? 1 : 0;
    piece.of_rate = {v,
                     piece.rate < 0   ? -kInfinity
                     : piece.rate > 0 ? full
                                      : -full,
                     piece.rate < 0   ? -full
                     : piece.rate > 0 ? kInfinity
                                      : full};
  }
  if (resistance.tension_only) {
    if (evaluate(resistance, x, v).load > 0) {
      const CurvePiece taut = resistance.positive.piece(x);
      piece.deflection = taut.number;
      piece.of_deflection = {x, taut.low, taut.high};
    } else {
      // At positive deflection it is slack while it shortens faster than its damping permits.
      piece.deflection = kSlack;
      piece.of_deflection = {x, -kInfinity, x > 0 ? kInfinity : 0};
    }
    return piece;
  }
  const CurvePiece passed = x < 0 ? resistance.negative.piece(-x) : resistance.positive.piece(x);
  if (passed.number == 0 && is_smooth_at_zero(resistance)) {
    piece.of_deflection = {x, -resistance.negative.piece(0).high,
                           resistance.positive.piece(0).high};
    return piece;
  }
  piece.deflection = x < 0 ? -1 - passed.number : 1 + passed.number;
  piece.of_deflection =
      x < 0 ? KinksAround{x, -passed.high, -passed.low} : KinksAround{x, passed.low, passed.high};
  return piece;
}

ResistanceLoad evaluate(const Resistance& resistance, double x, double v) {
  ResistanceLoad result;
  if (resistance.tension_only && !(x > 0)) return result;
  const double sign = x < 0 ? -1 : 1;
  const ResistanceSide& side = x < 0 ? resistance.negative : resistance.positive;
  const double direction =
      resistance.full_rate > 0 ? std::clamp(v / resistance.full_rate, -1.0, 1.0) : 0;
  // Between the loading curve (factor 1) and the unloading curve (its ratio), the mean is elastic;
  // the rest has the sign of the rate and only dissipates energy.
  const double share = (1 + side.unloading_ratio) / 2;
  const double loading = side.load(sign * x);
  const double elastic = sign * share * loading;
  result.stored_J = share * side.energy(sign * x);
  result.load = elastic + (1 - share) * loading * direction + resistance.damping * v +
                resistance.friction * direction;
  if (resistance.tension_only) result.load = std::max(result.load, 0.0);
  result.lost_W = (result.load - elastic) * v;
  return result;
}

}  // namespace flexneck::multibody
