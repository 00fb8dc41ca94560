// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/resistance.h"

#include <algorithm>

namespace flexneck::multibody {

double ResistanceSide::load(double x) const {
  return curve.value(x) + (x > stop ? beyond_stop.value(x - stop) : 0);
}

double ResistanceSide::energy(double x) const {
  return curve.energy(x) + (x > stop ? beyond_stop.energy(x - stop) : 0);
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
