// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/countdown.h"

#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace flexneck::pipeline {

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const double minutes = seconds / 60;
  if (minutes < 100) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.0f} h {:.0f} min", std::floor(minutes / 60), std::fmod(minutes, 60));
}

Countdown::Countdown(std::uint64_t due, std::string things, const Progress& tell)
    : due_(due), things_(std::move(things)), tell_(tell) {}

void Countdown::count(bool has_failed) {
  constexpr std::chrono::seconds kPause{3};
  ++done_;
  failed_ += has_failed ? 1U : 0U;
  const Clock::time_point now = Clock::now();
  if (now - told_ < kPause || done_ == due_ || !tell_) return;
  told_ = now;
  const std::chrono::duration<double> spent = now - start_;
  const auto left = static_cast<double>(due_ - done_);
  tell_(fmt::format("{} of {} {}{}, about {} left", done_, due_, things_,
                    failed_ > 0 ? fmt::format(", {} failed", failed_) : "",
                    duration_text(spent.count() / static_cast<double>(done_) * left)));
}

}  // namespace flexneck::pipeline
