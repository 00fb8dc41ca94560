// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/snap_search.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/history/recorder.h"
#include "multibody/time/motion.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSuspect = 2;  ///< multiple of the rate of the step before
constexpr int kHalvingsOfStep = 10;
/// Fraction of a step's motion in a thousandth of the step that is a jump: at a kink it is a
/// thousandth; where two equilibria separate, along a square root, a thirtieth.
constexpr double kJump = 0.25;
/// Motion, in m or rad, below which it is an error of the search; and fraction of the largest
/// motion below which a coordinate is ignored.
constexpr double kLeastMotion = 1e-8;
constexpr double kLeastShareOfMotion = 1e-4;

bool counts(const VectorXd& whole, Index k) {
  return std::abs(whole[k]) >
         std::max(kLeastMotion, kLeastShareOfMotion * whole.lpNorm<Eigen::Infinity>());
}

/// The largest fraction of a coordinate's motion that a part of the step has.
double share(const VectorXd& part, const VectorXd& whole) {
  double largest = 0;
  for (Index k = 0; k < whole.size(); ++k)
    if (counts(whole, k)) largest = std::max(largest, std::abs(part[k] / whole[k]));
  return largest;
}

}  // namespace

SnapSearch::SnapSearch(const Model& model, Equations& equations)
    : model_(model), equations_(equations) {}

bool SnapSearch::is_suspect(const Vector& moved, double duration_s) const {
  for (Index k = 0; k < moved.size(); ++k) {
    const bool is_fast = last_rates_.size() == 0 ||
                         std::abs(moved[k]) > kSuspect * duration_s * std::abs(last_rates_[k]);
    if (is_fast && counts(moved, k)) return true;
  }
  return false;
}

std::optional<SnapSearch::Place> SnapSearch::settled(const RunWatch& watch, const Place& from,
                                                     double time_s) {
  Place to{time_s, from.state};
  RunWatch aside = watch;
  try {
    settle_until(model_, equations_, aside, from.time_s, time_s, to.state);
  } catch (const ComputationError&) {
    return {};
  }
  return to;
}

/// Narrows the interval from begin to end around a jump.
/// @return true if a jump was found in it
bool SnapSearch::narrow(const RunWatch& watch, const Vector& whole, Place& begin, Place& end) {
  const Index count = whole.size();
  const auto moved = [&](const Place& from, const Place& to) -> VectorXd {
    return to.state.head(count) - from.state.head(count);
  };
  for (int halving = 0; halving < kHalvingsOfStep; ++halving) {
    const std::optional<Place> middle =
        settled(watch, begin, begin.time_s + (end.time_s - begin.time_s) / 2);
    const std::optional<Place> last = middle ? settled(watch, *middle, end.time_s) : std::nullopt;
    if (!last) return false;
    if (share(moved(begin, *middle), whole) >= share(moved(*middle, *last), whole)) {
      end = *middle;
    } else {
      begin = *middle;
      end = *last;
    }
    if (share(moved(begin, end), whole) < kJump) return false;
  }
  const std::optional<Place> back = settled(watch, end, begin.time_s);
  return back && share(moved(end, *back), moved(begin, end)) < 0.5;
}

void SnapSearch::look(const RunWatch& watch, double begin_s, const Vector& begin, double end_s,
                      const Vector& end) {
  const Index count = equations_.layout().positions;
  const VectorXd moved = end.head(count) - begin.head(count);
  const bool is_suspected = is_suspect(moved, end_s - begin_s);
  last_rates_ = moved / (end_s - begin_s);
  if (!is_suspected) return;
  Place from{begin_s, begin};
  Place to{end_s, end};
  if (narrow(watch, moved, from, to) && jumps_++ == 0) first_ = motion_text(from, to);
  settled(watch, {end_s, end}, end_s);  // the equations continue to count turns from there
}

/// Text on the motion of the marker that moves most.
std::string SnapSearch::motion_text(const Place& begin, const Place& end) {
  const auto markers = [&](const Place& place) {
    OutputOptions one;
    one.begin_time_s = one.end_time_s = place.time_s;
    Recorder recorder(model_, one);
    VectorXd state = place.state;
    recorder.begin(0);
    equations_.record(place.time_s, state, recorder, 0);
    return recorder.take().markers;
  };
  const std::vector<MarkerHistory> before = markers(begin);
  const std::vector<MarkerHistory> after = markers(end);
  double largest_m = 0;
  std::string name;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double moved_m = (after[k].position_m.col(0) - before[k].position_m.col(0)).norm();
    if (moved_m < largest_m) continue;
    largest_m = moved_m;
    name = after[k].name;
  }
  constexpr int kDigitsOfTime = 5;
  return rounded_text(end.time_s, kDigitsOfTime) + " s: '" + name + "' moves by " +
         rounded_text(largest_m, 3) + " m while the load hardly does";
}

std::vector<std::string> SnapSearch::warnings() const {
  if (jumps_ == 0) return {};
  return {"the equilibrium jumps at " + first_ +
          (jumps_ == 1 ? "" : ", the first of " + std::to_string(jumps_) + " jumps") +
          "; behind it the quasi-static run is at one of several equilibria, perhaps not at that "
          "of the motion: analysis = \"motion\" tells"};
}

}  // namespace flexneck::multibody
