// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/run_watch.h"

#include <algorithm>
#include <cmath>

namespace flexneck::multibody {

RunWatch::RunWatch(const Model& model)
    : deformation_(model), turns_(model, markers_), angles_(model, markers_) {}

double RunWatch::fastest_rad_s() const {
  return std::max(turns_.fastest_rad_s(markers_), angles_.fastest_rad_s(markers_));
}

int RunWatch::looks_until(double time_s) const {
  constexpr double kApart_rad = 1;
  constexpr double kMost = 1e6;  // consecutive states are so far apart only if rates diverge
  const double turned =
      (time_s - looked_s_) * std::max(looked_fastest_rad_s_, fastest_rad_s()) / kApart_rad;
  return 1 + static_cast<int>(turned < kMost ? turned : kMost);
}

void RunWatch::look(double time_s) {
  turns_.check(time_s, markers_);
  angles_.count(time_s, markers_);
  looked_s_ = time_s;
  looked_fastest_rad_s_ = fastest_rad_s();
}

}  // namespace flexneck::multibody
