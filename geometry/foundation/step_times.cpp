// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/step_times.h"

#include <algorithm>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/output_file.h"

namespace flexneck {

void StepTimes::start(const std::string& step) {
  stop();
  running_ = step;
  since_ = Clock::now();
}

void StepTimes::stop() {
  if (running_.empty()) return;
  auto step = std::find_if(steps_.begin(), steps_.end(),
                           [&](const Step& known) { return known.name == running_; });
  if (step == steps_.end()) step = steps_.insert(step, {running_});
  step->spent_s += std::chrono::duration<double>(Clock::now() - since_).count();
  step->peak_bytes = peak_memory();
  running_.clear();
}

std::string StepTimes::summary() const {
  constexpr double kGigabyte = 1e9;
  std::string text;
  double whole = 0;
  for (const Step& step : steps_) {
    text += step.name + " " + fixed_text(step.spent_s, 2) + " s, " +
            fixed_text(step.peak_bytes / kGigabyte, 2) + " GB; ";
    whole += step.spent_s;
  }
  return text + fixed_text(whole, 2) + " s together";
}

}  // namespace flexneck
