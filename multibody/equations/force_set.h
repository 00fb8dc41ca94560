// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// A marker as the forces see it, world axes.
struct ForceMarker {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< marker axes to world
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  // Answer: what acts on the marker's body, the moment about the marker's origin.
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
};

/// All forces of a model (equations.md section 8). Both formulations hand in the motion of the
/// markers that forces touch and apply the loads they get.
class ForceSet {
 public:
  /// @param model  sound (see check()); must outlive this
  explicit ForceSet(const Model& model);

  /// The markers that forces touch, distinct; slot k belongs to markers()[k].
  const std::vector<std::size_t>& markers() const { return markers_; }
  ForceMarker& slot(std::size_t k) { return slots_[k]; }
  const ForceMarker& slot(std::size_t k) const { return slots_[k]; }

  /// Loads and powers of the motions in the slots. Allocates nothing.
  void evaluate(double time_s);

  double stored_J() const { return stored_J_; }  ///< in springs and bushings
  double lost_W() const { return lost_W_; }      ///< to dampers, friction and hysteresis
  /// Power of forces and torques on bodies that are not driven, and of driven bodies through
  /// springs and bushings.
  double work_W() const { return work_W_; }
  /// Energy that springs store and that forces would give if they stayed as they are.
  double potential_J() const { return stored_J_ + potential_J_; }

  /// Which smooth pieces of their laws springs and resistances were on in the last evaluate(): two
  /// numbers for each (LawPiece). A motion along which one changes meets a kink of a load.
  const std::vector<int>& pieces() const { return pieces_; }
  /// What happens where the number of this index changes.
  std::string name_of_piece(std::size_t index) const;

  /// Adds the times at which a table has a kink or a jump.
  void add_breakpoints(std::vector<double>& times_s) const;

 private:
  /// Two slots between which a load acts.
  struct Pair {
    std::size_t i, j;
  };

  std::size_t slot_of(std::size_t marker);
  Pair pair_of(std::size_t marker_i, std::size_t marker_j);
  void apply_pair(const Pair& pair, const Eigen::Vector3d& force_on_j,
                  const Eigen::Vector3d& moment_on_j);
  void apply_spring(std::size_t index);
  void apply(const Bushing& bushing, const Pair& pair);
  void apply_resistance(std::size_t index);
  /// @param law  springs first, then resistances
  void set_piece(std::size_t law, const LawPiece& piece);
  /// @param h  the joint's axis on i, world
  void apply_flexion(std::size_t index, const Eigen::Vector3d& h);

  const Model& model_;
  std::vector<std::size_t> markers_;
  std::vector<ForceMarker> slots_;
  std::vector<bool> driven_;  ///< of the slots
  std::vector<std::size_t> force_slots_, torque_slots_;
  std::vector<Pair> spring_pairs_, bushing_pairs_, resistance_pairs_;
  std::vector<int> pieces_;
  double stored_J_ = 0, lost_W_ = 0, work_W_ = 0, potential_J_ = 0;
};

}  // namespace flexneck::multibody
