// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

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

}  // namespace flexneck::multibody
