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

int ResistanceSide::piece(double x) const {
  // Rows of both curves are passed one by one as x grows.
  return curve.piece(x) + (x > stop ? 1 + beyond_stop.piece(x - stop) : 0);
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
    refuse_force(who,
                 "friction and hysteresis need the rate at which they are complete (full_rate)");
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
  LawPiece piece;
  if (depends_on_direction(resistance))
    piece.rate = v <= -resistance.full_rate ? -1 : v >= resistance.full_rate ? 1 : 0;
  if (resistance.tension_only) {
    piece.deflection = evaluate(resistance, x, v).load > 0 ? resistance.positive.piece(x) : kSlack;
    return piece;
  }
  const int passed = x < 0 ? resistance.negative.piece(-x) : resistance.positive.piece(x);
  if (passed == 0 && is_smooth_at_zero(resistance)) return piece;
  piece.deflection = x < 0 ? -1 - passed : 1 + passed;
  return piece;
}

ResistanceLoad evaluate(const Resistance& resistance, double x, double v) {
  ResistanceLoad result;
  if (resistance.tension_only && !(x > 0)) return result;
  const double sign = x < 0 ? -1 : 1;
  const ResistanceSide& side = x < 0 ? resistance.negative : resistance.positive;
  const double direction =
      resistance.full_rate > 0 ? std::clamp(v / resistance.full_rate, -1.0, 1.0) : 0;
  // Between loading (1) and unloading (its ratio): the mean is elastic, what is left follows the
  // direction of motion and only ever loses energy.
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
