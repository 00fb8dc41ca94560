// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/step_times.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace flexneck {
namespace {

std::string seconds(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

}  // namespace

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
    text += (text.empty() ? "" : ", ") + name + " " + seconds(spent);
    whole += spent;
  }
  return text + "; " + seconds(whole) + " s together";
}

}  // namespace flexneck
