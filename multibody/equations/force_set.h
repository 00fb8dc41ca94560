// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// A marker as the forces see it, world axes.
struct ForceMarker : MarkerKinematics {
  // Answer: what acts on the marker's body, the moment about the marker's origin.
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
};

/// Where the internal variables of the force elements' branches are, in their order.
std::vector<InternalBlock> internal_blocks(const Forces& forces);
/// How many there are.
Eigen::Index internal_count(const Forces& forces);
/// What messages call a branch by its index among all.
std::string name_of_branch(const Forces& forces, std::size_t branch);

/// All force elements of a model (equations.md section 8), whatever their kinds. Both formulations
/// hand in the motion of the markers that forces touch and apply the loads they get.
class ForceSet {
 public:
  /// @param model  sound (see check()); must outlive this
  explicit ForceSet(const Model& model);

  /// The markers that forces touch, distinct; slot k belongs to markers()[k].
  const std::vector<std::size_t>& markers() const { return markers_; }
  /// The markers of each force element: on their motion its loads depend.
  std::vector<std::vector<std::size_t>> markers_of_elements() const;
  ForceMarker& slot(std::size_t k) { return slots_[k]; }
  const ForceMarker& slot(std::size_t k) const { return slots_[k]; }

  // What evaluate() takes the internal variables to be, from now on.
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;
  /// Relaxed, as at first: at rest for long.
  void relax() { known_ = InternalVariables::Known::relaxed; }
  /// Those given, (internal_count).
  void give_internal(const ConstVector& values);
  /// Those at the end of a step over which strains change evenly, from these values and rates.
  void begin_step(const ConstVector& values, const ConstVector& rates, double length_s);
  void follow_step() { known_ = InternalVariables::Known::begin; }
  /// Of the last evaluate(), and their rates.
  const Eigen::VectorXd& internal() const { return internal_; }
  const Eigen::VectorXd& internal_rate() const { return internal_rate_; }

  /// Joints whose angles elements act on.
  const std::vector<std::size_t>& turned_joints() const { return turned_joints_; }
  /// The angle of a joint, of the model's, as it was seen last: evaluate() counts on from there.
  CountedAngle& angle(std::size_t joint) { return angles_[joint]; }
  const CountedAngle& angle(std::size_t joint) const { return angles_[joint]; }

  /// Loads and powers of the motions in the slots. Allocates nothing.
  void evaluate(double time_s);

  double stored_J() const { return sums_.stored_J; }  ///< potential energy of the elements
  double lost_W() const { return sums_.lost_W; }      ///< to dampers, friction and hysteresis
  /// Power that loads from outside give to bodies that are not prescribed, and prescribed bodies to
  /// these through force elements.
  double work_W() const { return sums_.work_W; }
  /// Energy that elements store and that loads would give if they stayed as they are.
  double potential_J() const { return sums_.stored_J + sums_.potential_J; }

  /// Calls visit(element, marker i, marker j) for each function force, as they moved in the last
  /// evaluate().
  template <class Visit>
  void each_function(const Visit& visit) const {
    const auto& forces = model_.forces.of<FunctionForce>();
    const auto& slots = std::get<Slots<FunctionForce>>(slots_of_kind_).of_element;
    for (std::size_t k = 0; k < forces.size(); ++k)
      visit(forces[k], slots_[slots[k].front()], slots_[slots[k].back()]);
  }

  /// Which smooth pieces of their laws elements were on in the last evaluate(): two numbers for
  /// each PiecewiseForce (LawPiece). A motion along which one changes meets a kink of a load.
  const std::vector<int>& pieces() const { return pieces_; }
  /// Beside each of them the coordinate that it goes by, with the kinks around it.
  const std::vector<KinksAround>& kinks() const { return kinks_; }
  /// Tells whether it goes by a deflection, not by a rate.
  static bool is_deflection(std::size_t piece) { return piece % 2 == 0; }
  /// What happens where the number of this index changes.
  std::string name_of_piece(std::size_t index) const;

  /// Adds the times at which a table has a kink or a jump, and the breakpoints of functions.
  void add_breakpoints(std::vector<double>& times_s) const;

 private:
  /// The slots that each element of a kind loads, of i and of j.
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
  std::vector<bool> prescribed_;  ///< of the slots
  Forces::OfEachKind<Slots> slots_of_kind_;
  std::vector<int> pieces_;
  std::vector<KinksAround> kinks_;
  std::vector<std::size_t> turned_joints_;
  std::vector<CountedAngle> angles_;  ///< of the joints
  InternalVariables::Known known_ = InternalVariables::Known::relaxed;
  Eigen::VectorXd internal_, internal_rate_;
  Eigen::VectorXd given_, begin_, begin_rate_;
  std::vector<BranchStep> steps_;  ///< of the branches over the step that was begun
  ForceEnergies sums_;
};

}  // namespace flexneck::multibody
