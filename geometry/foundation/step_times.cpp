// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/step_times.h"

#include <algorithm>

#include "geometry/foundation/output_file.h"

namespace flexneck {

void StepTimes::start(const std::string& step) {
  stop();
  running_ = step;
  since_ = Clock::now();
}

void StepTimes::stop() {
  if (running_.empty()) return;
  const double spent = std::chrono::duration<double>(Clock::now() - since_).count();
  const auto step = std::find_if(steps_.begin(), steps_.end(),
                                 [&](const auto& known) { return known.first == running_; });
  if (step == steps_.end()) {
    steps_.emplace_back(running_, spent);
  } else {
    step->second += spent;
  }
  running_.clear();
}

std::string StepTimes::summary() const {
  std::string text;
  double whole = 0;
  for (const auto& [name, spent] : steps_) {
    text += (text.empty() ? "" : ", ") + name + " " + fixed_text(spent, 2);
    whole += spent;
  }
  return text + "; " + fixed_text(whole, 2) + " s together";
}

}  // namespace flexneck
