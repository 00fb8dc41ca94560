// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Finds where a row of static equilibria jumps: where the one that was followed ends, as at a
/// snap-through, and a step moves by much more than its load's increment explains.
///
/// A step is suspected that moves some coordinate by more than twice what the step before did, for
/// its time, and the first one. It is halved towards where it moves most. It jumps if a thousandth
/// of it has a quarter of its motion, and if that does not come back with the load: so does the
/// motion under a load that jumps itself.
class SnapSearch {
 public:
  using Vector = Eigen::VectorXd;

  /// @param equations  with prescribed bodies held
  SnapSearch(const Model& model, Equations& equations);

  /// @param begin,end  equilibria at these times, the second sought from the first
  void look(const RunWatch& watch, double begin_s, const Vector& begin, double end_s,
            const Vector& end);

  /// A sentence on the first jump and how many there are, if there are any.
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
  Vector last_rates_;  ///< of positions, in the step before; none before the second
  int jumps_ = 0;
  std::string first_;
};

}  // namespace flexneck::multibody
