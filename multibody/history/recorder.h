// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "multibody/history/history.h"
#include "multibody/history/output_options.h"
#include "multibody/history/run_watch.h"
#include "multibody/model/joint_check.h"
#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"

namespace flexneck::multibody {

/// The beginning and multiples of the interval from it up to the end, and the end.
class OutputTimes {
 public:
  explicit OutputTimes(const OutputOptions& output);
  Eigen::Index count() const { return count_; }
  double operator[](Eigen::Index column) const {
    return column + 1 < count_ ? begin_s_ + static_cast<double>(column) * interval_s_ : end_s_;
  }

 private:
  double begin_s_, interval_s_, end_s_;
  Eigen::Index count_;
};

/// How many numbers an output has.
Eigen::Index numbers_per_output(const Model& model);

/// Fills a history, one column per output time, in their order. Of a run that hands its outputs on,
/// it has one block at a time.
class Recorder {
 public:
  Recorder(const Model& model, const OutputOptions& output)
      : Recorder(model, output, RunWatch(model)) {}
  /// @param watch  of a run that has begun
  Recorder(const Model& model, const OutputOptions& output, RunWatch watch);

  /// Looks at each output, and between outputs where it is shown more.
  RunWatch& watch() { return watch_; }

  double time_s(Eigen::Index column) const { return times_[column]; }
  Eigen::Index columns() const { return times_.count(); }

  /// Before the first of a column: hands on the block that it does not belong to.
  void begin(Eigen::Index column);
  void marker(Eigen::Index column, std::size_t index, const MarkerState& motion);
  /// @param world  in world axes
  /// @param R_i    marker i's axes to the world
  void joint(Eigen::Index column, std::size_t index, const Reaction& world,
             const Eigen::Matrix3d& R_i);
  /// @param body  among the model's bodies; nothing is recorded of one that has no modes
  /// @throws ComputationError if it is deformed beyond reason, see DeformationGuard.
  void modal(Eigen::Index column, std::size_t body, const Eigen::VectorXd& a);
  /// Whether state() and internal() are asked for.
  bool keeps_states() const { return !history_.state.bodies.empty(); }
  /// @param body  among the model's bodies, not prescribed
  void state(Eigen::Index column, std::size_t body, const BodyState& motion);
  void internal(Eigen::Index column, const Eigen::VectorXd& variables);
  /// @param joint  among the model's joints, of those that have an angle
  void joint_angle(Eigen::Index column, std::size_t joint, double angle_rad);
  void energy(Eigen::Index column, const Energies& stored, double dissipated_J, double work_J);
  /// Where nothing is lost, behind energy(): the work is what the energies have gained since the
  /// first column.
  void conserve_energy(Eigen::Index column);
  /// Records the angles, once all markers are. @throws ComputationError as RunWatch::look().
  void look(Eigen::Index column);
  /// Of one joint; the largest of all counts.
  void residuals(Eigen::Index column, const Violation& position, const Violation& velocity);

  StepStatistics& statistics() { return history_.statistics; }
  /// Adds to what is undetermined of a joint's reaction.
  /// @param components  of force and moment in marker i's axes
  void undetermined(std::size_t joint, const Eigen::Array<bool, 6, 1>& components);
  /// At the start: freedoms, redundant constraints, and sentences on what is in doubt.
  void mobility(int freedoms, std::vector<std::string> redundant, std::vector<std::string> doubts);
  History take();
  /// The columns before this one only, for a run that ended early.
  History take_incomplete(Eigen::Index column, const std::string& why);

 private:
  Eigen::Index place(Eigen::Index column) const { return column - history_.handed_on; }
  void prepare_states(const Model& model);
  /// Room for the block that begins after what was handed on.
  void make_room();

  OutputTimes times_;
  Eigen::Index block_;
  std::function<void(const History&)> sink_;
  History history_;
  RunWatch watch_;
  std::vector<std::size_t> modal_of_body_, state_of_body_, state_of_joint_;
  std::vector<std::optional<std::size_t>> watched_;  ///< place of the markers in the watch
  std::vector<Eigen::Vector4d> last_rotations_;      ///< of the markers, in the block before
  double first_energy_J_ = 0;
  std::vector<Eigen::Array<bool, 6, 1>> undetermined_;
};

}  // namespace flexneck::multibody
