// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Motion of a marker as the forces need it, and the load on it, world axes.
struct ForceMarker : MarkerKinematics {
  // Result: load on the marker's body, the moment about the marker's origin.
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
};

/// Blocks of the internal variables of the force elements' branches, in their order.
std::vector<InternalBlock> internal_blocks(const Forces& forces);
/// Number of internal variables.
Eigen::Index internal_count(const Forces& forces);
/// Name of a branch in messages, by its index among all.
std::string name_of_branch(const Forces& forces, std::size_t branch);

/// All force elements of a model (equations.md section 8), of all kinds. Both formulations pass in
/// the motion of the markers that forces touch and apply the resulting loads.
class ForceSet {
 public:
  /// @param model  sound (see check()); must outlive this
  explicit ForceSet(const Model& model);

  /// The markers that forces touch, distinct; slot k belongs to markers()[k].
  const std::vector<std::size_t>& markers() const { return markers_; }
  /// The markers of each force element, on whose motion its loads depend.
  std::vector<std::vector<std::size_t>> markers_of_elements() const;
  ForceMarker& slot(std::size_t k) { return slots_[k]; }
  const ForceMarker& slot(std::size_t k) const { return slots_[k]; }

  // These choose the internal variables of the following calls of evaluate().
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;
  /// Relaxed variables, as after a long time at rest; the default.
  void relax() { known_ = InternalVariables::Known::relaxed; }
  /// Given values, (internal_count).
  void give_internal(const ConstVector& values);
  /// Values at the end of a step over which strains change evenly, from these values and rates.
  void begin_step(const ConstVector& values, const ConstVector& rates, double length_s);
  void follow_step() { known_ = InternalVariables::Known::begin; }
  /// Internal variables of the last evaluate(), and their rates.
  const Eigen::VectorXd& internal() const { return internal_; }
  const Eigen::VectorXd& internal_rate() const { return internal_rate_; }

  /// Joints on whose angles elements act.
  const std::vector<std::size_t>& turned_joints() const { return turned_joints_; }
  /// The angle of a joint, by the model's index, as last counted: evaluate() continues from it.
  CountedAngle& angle(std::size_t joint) { return angles_[joint]; }
  const CountedAngle& angle(std::size_t joint) const { return angles_[joint]; }

  /// Computes loads and powers for the motions in the slots. Allocates nothing.
  void evaluate(double time_s);

  double stored_J() const { return sums_.stored_J; }  ///< potential energy of the elements
  double lost_W() const { return sums_.lost_W; }      ///< to dampers, friction and hysteresis
  /// Power that external loads give to bodies that are not prescribed, and that prescribed bodies
  /// give to these through force elements.
  double work_W() const { return sums_.work_W; }
  /// Stored energy of the elements plus the potential of loads as if they were constant.
  double potential_J() const { return sums_.stored_J + sums_.potential_J; }

  /// Calls visit(element, marker i, marker j) for each function force with the motion of the last
  /// evaluate().
  template <class Visit>
  void each_function(const Visit& visit) const {
    const auto& forces = model_.forces.of<FunctionForce>();
    const auto& slots = std::get<Slots<FunctionForce>>(slots_of_kind_).of_element;
    for (std::size_t k = 0; k < forces.size(); ++k)
      visit(forces[k], slots_[slots[k].front()], slots_[slots[k].back()]);
  }

  /// Numbers of the smooth pieces of their laws on which elements were in the last evaluate(): two
  /// for each PiecewiseForce (LawPiece). Where one changes along a motion, a load has a kink.
  const std::vector<int>& pieces() const { return pieces_; }
  /// For each of pieces(), the coordinate that determines it, with the nearest kinks.
  const std::vector<KinksAround>& kinks() const { return kinks_; }
  /// Returns whether a piece is determined by a deflection, not by a rate.
  static bool is_deflection(std::size_t piece) { return piece % 2 == 0; }
  /// Description of the event at which the piece with this index changes.
  std::string name_of_piece(std::size_t index) const;

  /// Adds the times at which a table has a kink or a jump, and the breakpoints of functions.
  void add_breakpoints(std::vector<double>& times_s) const;

 private:
  /// For each element of a kind, the slots of its markers i and j.
  template <class Kind>
  struct Slots {
    using Indices = decltype(std::declval<Kind>().markers({}));
    std::vector<Indices> of_element;
  };

  std::size_t slot_of(std::size_t marker);
  InternalVariables internal_variables();

  const Model& model_;
  std::vector<std::size_t> markers_;
  std::vector<ForceMarker> slots_;
  std::vector<bool> prescribed_;  ///< by slot
  Forces::OfEachKind<Slots> slots_of_kind_;
  std::vector<int> pieces_;
  std::vector<KinksAround> kinks_;
  std::vector<std::size_t> turned_joints_;
  std::vector<CountedAngle> angles_;  ///< by joint
  InternalVariables::Known known_ = InternalVariables::Known::relaxed;
  Eigen::VectorXd internal_, internal_rate_;
  Eigen::VectorXd given_, begin_, begin_rate_;
  std::vector<BranchStep> steps_;  ///< factors of each branch over the step of begin_step()
  ForceEnergies sums_;
};

}  // namespace flexneck::multibody
