// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/chatter_guard.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

/// Number of steps that are counted together, and how many of them must reverse a force for it to
/// be examined: in a run that advances, one in ten or more steps passes a jump.
constexpr int kSteps = 200;
constexpr int kTurnOvers = 100;
/// A load reverses if it changes by this fraction of its size, and it jumps if that change remains
/// in an interval after so many halvings.
constexpr double kShare = 0.5;
constexpr int kHalvings = 30;

}  // namespace

ChatterGuard::ChatterGuard(Equations& equations) : equations_(equations) {
  std::size_t count = 0;
  equations.forces().each_function([&](const auto&, const auto&, const auto&) { ++count; });
  last_.assign(count, Load::Zero());
  now_ = last_;
  turn_overs_.assign(count, 0);
}

void ChatterGuard::take(double time_s, std::vector<Load>& loads) const {
  std::size_t k = 0;
  equations_.forces().each_function([&](const FunctionForce& force, const auto& i, const auto& j) {
    const FunctionLoad found = force.load(time_s, relative_motion(i, j));
    loads[k++] << found.force_N, found.moment_Nm;
  });
}

std::string ChatterGuard::name_of(std::size_t force) const {
  std::string name;
  std::size_t k = 0;
  equations_.forces().each_function([&](const FunctionForce& each, const auto&, const auto&) {
    if (k++ == force) name = title(each);
  });
  return name;
}

void ChatterGuard::check(const TimeIntegrator& integrator) {
  if (last_.empty()) return;
  take(integrator.time_s(), now_);
  std::size_t chatters = now_.size();
  for (std::size_t k = 0; k < now_.size(); ++k) {
    const double size = std::max(now_[k].norm(), last_[k].norm());
    if ((now_[k] - last_[k]).norm() > kShare * size && ++turn_overs_[k] >= kTurnOvers) chatters = k;
  }
  if (chatters < now_.size() && jumps(integrator, chatters)) {
    constexpr int kDigits = 9;
    throw ComputationError(
        name_of(chatters) + " switches back and forth at " +
        rounded_text(integrator.time_s(), kDigits) +
        " s, so that the run cannot continue: both sides of the jump lead back to it, as for "
        "friction written as the sign of a velocity; make it continuous, such as F * tanh(vx / v0) "
        "with a small v0, or use a [[resistance]] with friction and full_rate");
  }
  if (chatters < now_.size() || ++steps_ == kSteps) {
    std::fill(turn_overs_.begin(), turn_overs_.end(), 0);
    steps_ = 0;
  }
  last_.swap(now_);
  last_time_s_ = integrator.time_s();
}

/// Halves the last step towards the largest change of the load.
bool ChatterGuard::jumps(const TimeIntegrator& integrator, std::size_t force) {
  const double begin_s = last_time_s_;
  const double length_s = integrator.time_s() - begin_s;
  Load at_begin = last_[force];
  Load at_end = now_[force];
  std::vector<Load> loads = now_;
  const double whole = (at_end - at_begin).norm();
  state_ = integrator.state();
  rate_ = state_;
  double share_begin = 0;
  double share_end = 1;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (share_begin + share_end) / 2;
    const double time_s = begin_s + middle * length_s;
    integrator.interpolate(time_s, state_);
    equations_.derivative(time_s, state_, rate_);
    take(time_s, loads);
    const Load& here = loads[force];
    if ((here - at_begin).norm() > (at_end - here).norm()) {
      share_end = middle;
      at_end = here;
    } else {
      share_begin = middle;
      at_begin = here;
    }
  }
  state_ = integrator.state();
  equations_.derivative(integrator.time_s(), state_, rate_);
  return (at_end - at_begin).norm() > kShare * whole;
}

}  // namespace flexneck::multibody
