// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/history.h"
#include "multibody/joint_check.h"
#include "multibody/model.h"
#include "multibody/motion_state.h"
#include "multibody/simulation.h"

namespace flexneck::multibody {

/// Multiples of the interval up to the end, and the end.
Eigen::VectorXd output_times(const OutputOptions& output);

/// Fills a history, one column per output time.
class Recorder {
 public:
  Recorder(const Model& model, const Eigen::VectorXd& times_s);

  double time_s(Eigen::Index column) const { return history_.time_s[column]; }
  Eigen::Index columns() const { return history_.time_s.size(); }

  void marker(Eigen::Index column, std::size_t index, const MarkerState& motion);
  /// @param world  in world axes
  /// @param R_i    marker i's axes to the world
  void joint(Eigen::Index column, std::size_t index, const Reaction& world,
             const Eigen::Matrix3d& R_i);
  /// @param body  among the model's bodies; nothing is recorded of one that has no modes
  void modal(Eigen::Index column, std::size_t body, const Eigen::VectorXd& a);
  void energy(Eigen::Index column, const Energies& stored, double dissipated_J, double work_J);
  /// Of one joint; the largest of all counts.
  void residuals(Eigen::Index column, const Violation& position, const Violation& velocity);

  StepStatistics& statistics() { return history_.statistics; }
  /// Adds to what is undetermined of a joint's reaction.
  /// @param components  of force and moment in marker i's axes
  void undetermined(std::size_t joint, const Eigen::Array<bool, 6, 1>& components);
  void redundant(std::vector<std::string> constraints);
  History take();
  /// The first columns only, for a run that ended early.
  History take_incomplete(Eigen::Index columns, const std::string& why);

 private:
  History history_;
  std::vector<std::size_t> modal_of_body_;
  std::vector<Eigen::Array<bool, 6, 1>> undetermined_;
};

}  // namespace flexneck::multibody
