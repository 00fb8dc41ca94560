// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/cable.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "multibody/forces/arc.h"

namespace flexneck::multibody {
namespace {

using Eigen::Vector3d;

/// Pull less preload, its energy, and the piece of the law.
struct Pull {
  Pull(const Cable& cable, double x) {
    const double k = cable.stiffness_N_m;
    kinks = {x, 0, cable.play_m};
    if (x > cable.play_m) {
      extra_N = k * (x - cable.play_m);
      energy_J = extra_N * (x - cable.play_m) / 2;
      piece = 1;
      kinks = {x, cable.play_m, kInfinity};
    } else if (x < 0) {
      // The pull can decrease by the preload at most.
      const double given_up_N = std::min(-k * x, cable.preload_N);
      const double slack_m = given_up_N < -k * x ? -x - cable.preload_N / k : 0;
      extra_N = -given_up_N;
      energy_J = given_up_N * (-x - slack_m) / 2 + given_up_N * slack_m;
      piece = slack_m > 0 ? -2 : -1;
      const double slack_at_m = -cable.preload_N / k;
      kinks = slack_m > 0 ? KinksAround{x, -kInfinity, slack_at_m} : KinksAround{x, slack_at_m, 0};
    }
  }

  double extra_N = 0;
  double energy_J = 0;
  int piece = 0;
  KinksAround kinks;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

/// The arc from one marker to the other.
struct Path {
  Path(const MarkerKinematics& i, const MarkerKinematics& j, const Vector3d& axis)
      : line(j.p - i.p),
        chord_m(line.norm()),
        theta(rotation_log(i.R.transpose() * j.R)),
        arc(part_across(theta, axis)) {}

  Vector3d line;
  double chord_m;
  Vector3d theta;
  ArcShortening arc;
  double length_m() const { return chord_m / arc.ratio; }
};

}  // namespace

double Cable::path_m(const MarkerKinematics& i, const MarkerKinematics& j) const {
  return Path(i, j, axis).length_m();
}

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
  const Path path(input.i, input.j, axis);
  if (!(path.chord_m > kNoDirection)) return;
  const Pull pull(*this, path.length_m() - length_m);
  sums.stored_J += pull.energy_J;
  load.piece = {pull.piece, 0, pull.kinks};
  const double ratio = path.arc.ratio;
  load.force_N = -pull.extra_N / (ratio * path.chord_m) * path.line;
  // The path's gradient with respect to theta is -chord / ratio^2 times that of the ratio.
  const Vector3d by_theta = pull.extra_N * path.chord_m / (ratio * ratio) * path.arc.gradient;
  load.moment_Nm = input.i.R * HalfTurn(path.theta).to_moment(by_theta);
}

}  // namespace flexneck::multibody
