// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/cable.h"

#include <algorithm>
#include <cmath>

#include "multibody/forces/arc.h"

namespace flexneck::multibody {
namespace {

using Eigen::Vector3d;

/// Pull less preload, the energy that goes with it, and which piece of the law it is on.
struct Pull {
  Pull(const Cable& cable, double x) {
    const double k = cable.stiffness_N_m;
    if (x > cable.play_m) {
      extra_N = k * (x - cable.play_m);
      energy_J = extra_N * (x - cable.play_m) / 2;
      piece = 1;
    } else if (x < 0) {
      // What the cable gives up at most is its preload.
      const double given_up_N = std::min(-k * x, cable.preload_N);
      const double slack_m = given_up_N < -k * x ? -x - cable.preload_N / k : 0;
      extra_N = -given_up_N;
      energy_J = given_up_N * (-x - slack_m) / 2 + given_up_N * slack_m;
      piece = slack_m > 0 ? -2 : -1;
    }
  }

  double extra_N = 0;
  double energy_J = 0;
  int piece = 0;
};

}  // namespace

void Cable::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  check_not_negative(who, "the preload", preload_N);
  check_not_negative(who, "the stiffness", stiffness_N_m);
  check_not_negative(who, "the play", play_m);
  if (!(length_m >= 0 && std::isfinite(length_m))) refuse_force(who, "the length must be positive");
  if (!(std::abs(axis.norm() - 1) < 1e-9)) refuse_force(who, "the axis must be a unit vector");
}

void Cable::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  load.piece = {};
  const Eigen::Matrix3d& R_i = input.i.R;
  const Vector3d line = input.j.p - input.i.p;
  const double chord_m = line.norm();
  if (!(chord_m > kNoDirection)) return;
  const Vector3d theta = rotation_log(R_i.transpose() * input.j.R);
  const ArcShortening arc(part_across(theta, axis));
  const Pull pull(*this, chord_m / arc.ratio - length_m);
  sums.stored_J += pull.energy_J;
  load.piece = {pull.piece, 0};
  load.force_N = -pull.extra_N / (arc.ratio * chord_m) * line;
  // The path's gradient over theta is -chord / ratio^2 times that of the ratio.
  const Vector3d by_theta = pull.extra_N * chord_m / (arc.ratio * arc.ratio) * arc.gradient;
  load.moment_Nm = R_i * HalfTurn(theta).to_moment(by_theta);
}

}  // namespace flexneck::multibody
