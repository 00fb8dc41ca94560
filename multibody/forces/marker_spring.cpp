// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/marker_spring.h"

namespace flexneck::multibody {

void MarkerSpring::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  check_not_negative(who, "the free length", free_length_m);
  check_resistance(who, resistance);
}

void MarkerSpring::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const Eigen::Vector3d line = input.j.p - input.i.p;
  const double length = line.norm();
  if (!(length > kNoDirection)) return;
  const Eigen::Vector3d direction = line / length;
  const double deflection = length - free_length_m;
  const double rate = direction.dot(input.j.v - input.i.v);
  const ResistanceLoad found = evaluate(resistance, deflection, rate);
  load.piece = piece_of(resistance, deflection, rate);
  sums.stored_J += found.stored_J;
  sums.lost_W += found.lost_W;
  load.force_N = -found.load * direction;
}

}  // namespace flexneck::multibody
