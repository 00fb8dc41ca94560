// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/equations/equations.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/model/model.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/time/motion.h"

namespace flexneck::multibody {

namespace {

/// Finds jumps in a sequence of static equilibria: the branch of equilibria that was followed ends,
/// as at a snap-through, and a step moves by much more than its load increment explains.
///
/// A step is suspected if it moves some coordinate by more than twice the motion of the step
/// before, relative to its duration; the first step is always suspected. It is halved towards the
/// largest motion. It is a jump if a thousandth of it has a quarter of its motion, and if that
/// motion is not undone when the load is: otherwise the load itself jumps.
class SnapSearch {
 public:
  using Vector = Eigen::VectorXd;

  /// @param equations  with fixed prescribed bodies
  SnapSearch(const Model& model, Equations& equations);

  /// Examines a step.
  /// @param begin,end  equilibria at these times, the second sought from the first
  void look(const RunWatch& watch, double begin_s, const Vector& begin, double end_s,
            const Vector& end);

  /// A warning on the first jump and the number of jumps; empty if there are none.
  std::vector<std::string> warnings() const;

 private:
  struct Place {
    double time_s;
    Vector state;
  };

  bool is_suspect(const Vector& moved, double duration_s) const;
  std::optional<Place> settled(const RunWatch& watch, const Place& from, double time_s);
  bool narrow(const RunWatch& watch, const Vector& whole, Place& begin, Place& end);
  std::string motion_text(const Place& begin, const Place& end);

  const Model& model_;
  Equations& equations_;
  Vector last_rates_;  ///< rates of positions in the step before; empty before the second step
  int jumps_ = 0;
  std::string first_;
};

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
         rounded_text(largest_m, 3) + " m while the load hardly changes";
}

std::vector<std::string> SnapSearch::warnings() const {
  if (jumps_ == 0) return {};
  return {"the equilibrium jumps at " + first_ +
          (jumps_ == 1 ? "" : ", the first of " + std::to_string(jumps_) + " jumps") +
          "; after it, the quasi-static run is at one of several equilibria, which may differ from "
          "that of the motion; check with analysis = \"motion\""};
}

/// The largest angle by which a prescribed body or a motor rotates from one time to another.
double prescribed_turn_rad(const Model& model, double begin_s, double end_s) {
  double largest = 0;
  for (const Body& body : model.bodies)
    if (const auto* prescribed = std::get_if<PrescribedBody>(&body.kind)) {
      const PrescribedPath path(body.initial_pose, *prescribed);
      largest = std::max(largest, std::abs(path.angle_rad(end_s) - path.angle_rad(begin_s)));
    }
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors)
      if (motor.coordinate == JointCoordinate::angle)
        largest = std::max(largest, std::abs(motor.path.value(end_s) - motor.path.value(begin_s)));
  return largest;
}

}  // namespace

void settle_until(const Model& model, Equations& equations, RunWatch& watch, double begin_s,
                  double end_s, Eigen::VectorXd& state) {
  constexpr double kApart_rad = 1;
  const int parts = 1 + static_cast<int>(prescribed_turn_rad(model, begin_s, end_s) / kApart_rad);
  for (int k = 1; k <= parts; ++k) {
    const double time_s = k < parts ? begin_s + (end_s - begin_s) * k / parts : end_s;
    equations.settle(time_s, state, watch);
  }
}

History settle_along(const Model& model, Equations& equations,
                     const std::function<void()>& checkpoint, const OutputOptions& output) {
  check_motions_reach(model, output.end_time_s);
  Recorder recorder(model, output);
  SnapSearch jumps(model, equations);
  const auto with_warnings = [&](History history) {
    for (const std::string& each : jumps.warnings()) history.warnings.push_back(each);
    return history;
  };
  const auto count = [&] { recorder.statistics().evaluations = equations.evaluations(); };
  Eigen::Index column = 0;
  try {
    Eigen::VectorXd state = equations.given_place();
    for (; column < recorder.columns(); ++column) {
      const double time_s = recorder.time_s(column);
      const double begin_s = recorder.time_s(std::max<Eigen::Index>(column - 1, 0));
      const Eigen::VectorXd before = state;
      settle_until(model, equations, recorder.watch(), begin_s, time_s, state);
      if (column > 0) jumps.look(recorder.watch(), begin_s, before, time_s, state);
      Eigen::VectorXd recorded = state;
      recorder.begin(column);
      equations.record(time_s, recorded, recorder, column);
      recorder.look(column);
      recorder.conserve_energy(column);
      if (column == 0)
        recorder.mobility(equations.freedoms(), equations.redundant_constraints(),
                          equations.doubts());
      if (checkpoint) checkpoint();
    }
  } catch (const ComputationError& error) {
    count();
    const std::string why =
        std::string(error.what()) + ", at " + rounded_text(recorder.time_s(column)) + " s";
    throw IncompleteRun(why, with_warnings(recorder.take_incomplete(column, why)));
  }
  count();
  return with_warnings(recorder.take());
}

}  // namespace flexneck::multibody
