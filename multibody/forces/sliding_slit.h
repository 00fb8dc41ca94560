// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/section.h"

namespace flexneck::multibody {

/// A section with friction in its slit (SlitFriction) under a motion of its top.
struct SlidingSlit {
  Section::Strain strain;  ///< [e; g; s]
  Section::Strain rate;    ///< of s, m/s; of e and g zero
  double lost_W = 0;       ///< to friction
  int which_open = 0;      ///< a bit for each gap
  bool slips = false;
};

/// Gaps and sliding that go with the motion e. Over a step sliding has the rate of the step's end
/// (implicit Euler). At rest for long no load is on s, as if there were no friction.
/// @param internal     of all branches, s the last block
/// @param tried_first  gaps that may be open, a bit each
SlidingSlit sliding_slit(const Section& section, const Eigen::Matrix<double, 6, 1>& e,
                         const InternalVariables& internal, int tried_first);

}  // namespace flexneck::multibody
