// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/function_force.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {

void FunctionForce::act(const ForceInput& input, ForceLoad& acting, ForceEnergies& sums) const {
  const MarkerKinematics& i = input.i;
  const MarkerKinematics& j = input.j;
  const Eigen::Vector3d line = j.p - i.p;
  RelativeMotion motion;
  motion.position_m = i.R.transpose() * line;
  motion.velocity_m_s = i.R.transpose() * (j.v - i.v - i.w.cross(line));
  motion.rotation = i.R.transpose() * j.R;
  motion.angular_velocity_rad_s = i.R.transpose() * (j.w - i.w);
  const FunctionLoad found = load(input.time_s, motion);
  if (!(found.force_N.allFinite() && found.moment_Nm.allFinite()))
    throw ComputationError(title(*this) + ": its function gives no finite load at " +
                           exact_text(input.time_s) + " s");
  acting.force_N = i.R * found.force_N;
  acting.moment_Nm = i.R * found.moment_Nm;
  sums.work_W +=
      found.force_N.dot(motion.velocity_m_s) + found.moment_Nm.dot(motion.angular_velocity_rad_s);
}

}  // namespace flexneck::multibody
