// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/function_force.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {

RelativeMotion relative_motion(const MarkerKinematics& i, const MarkerKinematics& j) {
  const Eigen::Vector3d line = j.p - i.p;
  RelativeMotion motion;
  motion.position_m = i.R.transpose() * line;
  motion.velocity_m_s = i.R.transpose() * (j.v - i.v - i.w.cross(line));
  motion.rotation = i.R.transpose() * j.R;
  motion.angular_velocity_rad_s = i.R.transpose() * (j.w - i.w);
  return motion;
}

void FunctionForce::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  if (!load) refuse_force(who, "expected a function, found none");
  for (std::size_t k = 0; k < breakpoints_s.size(); ++k)
    if (!std::isfinite(breakpoints_s[k]) || (k > 0 && !(breakpoints_s[k] > breakpoints_s[k - 1])))
      refuse_force(who, "expected breakpoints that increase, found " +
                            exact_text(breakpoints_s[k]) + " s as number " + std::to_string(k + 1));
}

void FunctionForce::act(const ForceInput& input, ForceLoad& acting, ForceEnergies& sums) const {
  const RelativeMotion motion = relative_motion(input.i, input.j);
  const FunctionLoad found = load(input.time_s, motion);
  if (!(found.force_N.allFinite() && found.moment_Nm.allFinite()))
    throw ComputationError(title(*this) + ": its function gives a load that is not finite at " +
                           exact_text(input.time_s) + " s");
  acting.force_N = input.i.R * found.force_N;
  acting.moment_Nm = input.i.R * found.moment_Nm;
  sums.work_W +=
      found.force_N.dot(motion.velocity_m_s) + found.moment_Nm.dot(motion.angular_velocity_rad_s);
}

}  // namespace flexneck::multibody
