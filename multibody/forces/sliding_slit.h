// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/section.h"

namespace flexneck::multibody {

/// State of a section with friction in its slit (SlitFriction) under a motion of its top.
struct SlidingSlit {
  Section::Strain strain;  ///< [e; g; s]
  Section::Strain rate;    ///< rate of s, m/s; zero for e and g
  double lost_W = 0;       ///< dissipated by friction
  int which_open = 0;      ///< a bit for each gap
  bool slips = false;
};

/// Gaps and sliding for the motion e. Over a step sliding has the rate at the step's end (implicit
/// Euler). After a long time at rest no load acts on s, as if there were no friction.
/// @param internal     variables of all branches, s the last block
/// @param tried_first  guess of the open gaps, a bit for each
SlidingSlit sliding_slit(const Section& section, const Eigen::Matrix<double, 6, 1>& e,
                         const InternalVariables& internal, int tried_first);

}  // namespace flexneck::multibody
