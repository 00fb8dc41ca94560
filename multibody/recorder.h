// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/equations_of_motion.h"
#include "multibody/history.h"
#include "multibody/model.h"

namespace flexneck::multibody {

/// Fills a history, one column per output time.
class Recorder {
 public:
  Recorder(const Model& model, const Eigen::VectorXd& times_s);

  double time_s(Eigen::Index column) const { return history_.time_s[column]; }
  Eigen::Index columns() const { return history_.time_s.size(); }
  /// @param equations  solved for `state` at the column's time
  void record(Eigen::Index column, EquationsOfMotion& equations, const Eigen::VectorXd& state);
  StepStatistics& statistics() { return history_.statistics; }
  History take() { return std::move(history_); }

 private:
  void record_marker(Eigen::Index column, std::size_t index, const EquationsOfMotion& equations);
  void record_energies(Eigen::Index column, const EquationsOfMotion& equations,
                       const Eigen::VectorXd& state);

  History history_;
};

}  // namespace flexneck::multibody
