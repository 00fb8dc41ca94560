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

/// Output times: the beginning, multiples of the interval after it up to the end, and the end.
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

/// Number of values in an output.
Eigen::Index numbers_per_output(const Model& model);

/// Fills a history, one column per output time, in their order. With a sink it holds one block of
/// the outputs at a time.
class Recorder {
 public:
  Recorder(const Model& model, const OutputOptions& output)
      : Recorder(model, output, RunWatch(model)) {}
  /// @param watch  watch of a run that has begun
  Recorder(const Model& model, const OutputOptions& output, RunWatch watch);

  /// The watch, which sees each output and further states between outputs.
  RunWatch& watch() { return watch_; }

  double time_s(Eigen::Index column) const { return times_[column]; }
  Eigen::Index columns() const { return times_.count(); }

  /// Begins a column; passes the previous block to the sink if the column does not belong to it.
  void begin(Eigen::Index column);
  void marker(Eigen::Index column, std::size_t index, const MarkerState& motion);
  /// @param world  reaction in world axes
  /// @param R_i    rotation from marker i's axes to the world
  void joint(Eigen::Index column, std::size_t index, const Reaction& world,
             const Eigen::Matrix3d& R_i);
  /// @param body  index among the model's bodies; nothing is recorded for one without modes
  /// @throws ComputationError if its deformation exceeds the limits of DeformationGuard.
  void modal(Eigen::Index column, std::size_t body, const Eigen::VectorXd& a);
  /// Returns whether state() and internal() are to be called.
  bool keeps_states() const { return !history_.state.bodies.empty(); }
  /// @param body  index among the model's bodies, not prescribed
  void state(Eigen::Index column, std::size_t body, const BodyState& motion);
  void internal(Eigen::Index column, const Eigen::VectorXd& variables);
  /// @param joint  index among the model's joints, of a joint with an angle
  void joint_angle(Eigen::Index column, std::size_t joint, double angle_rad);
  void energy(Eigen::Index column, const Energies& stored, double dissipated_J, double work_J);
  /// Sets the work, after energy(), for motions without dissipation: it is the gain of the energies
  /// since the first column.
  void conserve_energy(Eigen::Index column);
  /// Records the measured angles, after all markers.
  /// @throws ComputationError as RunWatch::look().
  void look(Eigen::Index column);
  /// Records the residuals of one joint; the largest of all joints is kept.
  void residuals(Eigen::Index column, const Violation& position, const Violation& velocity);

  StepStatistics& statistics() { return history_.statistics; }
  /// Adds undetermined components of a joint's reaction.
  /// @param components  of force and moment in marker i's axes
  void undetermined(std::size_t joint, const Eigen::Array<bool, 6, 1>& components);
  /// Records the mobility at the start: degrees of freedom, redundant constraints and warnings.
  void mobility(int freedoms, std::vector<std::string> redundant, std::vector<std::string> doubts);
  History take();
  /// Returns only the columns before this one, for a run that ended early.
  History take_incomplete(Eigen::Index column, const std::string& why);

 private:
  Eigen::Index place(Eigen::Index column) const { return column - history_.handed_on; }
  void prepare_states(const Model& model);
  /// Allocates the block that follows the outputs passed to the sink.
  void make_room();

  OutputTimes times_;
  Eigen::Index block_;
  std::function<void(const History&)> sink_;
  History history_;
  RunWatch watch_;
  std::vector<std::size_t> modal_of_body_, state_of_body_, state_of_joint_;
  std::vector<std::optional<std::size_t>> watched_;  ///< index of each marker in the watch
  std::vector<Eigen::Vector4d> last_rotations_;      ///< by marker, in the block before
  double first_energy_J_ = 0;
  std::vector<Eigen::Array<bool, 6, 1>> undetermined_;
};

}  // namespace flexneck::multibody
