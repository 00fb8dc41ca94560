// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/ranks.h"
#include "fe_modal/system/element_operator.h"

namespace flexneck::fe_modal {

/// What the modes of a finer mesh are sought in: the modes so far, the directions that they went,
/// and new ones; with K and M projected on them. Of the directions gone the modes take little:
/// these are kept in single precision.
class RefinedBasis {
 public:
  /// Columns with their forces and momenta. The latter are in single precision: in residuals they
  /// are no larger than what is sought, where terms of the forces cancel by six digits.
  template <typename Number>
  struct Block {
    Eigen::MatrixX<Number> vectors;
    Eigen::MatrixX<Number> forces;
    Eigen::MatrixXf momenta;
  };
  using Modes = Block<double>;

  /// What does not change its size is allocated here: among the vectors that come and go it would
  /// fragment the heap.
  /// @param size of a vector
  /// @param modes, directions how many there are at most
  RefinedBasis(const Ranks& ranks, Eigen::Index size, Eigen::Index modes, Eigen::Index directions);

  /// Modes, where there are none yet, or new directions.
  void append(Eigen::MatrixXd vectors, ElementOperator::Products products);

  const Modes& modes() const { return modes_; }
  auto stiffness() const { return stiffness_.topLeftCorner(count_, count_); }
  auto mass() const { return mass_.topLeftCorner(count_, count_); }
  /// Combinations of the vectors of all columns.
  Eigen::MatrixXd combined(const Eigen::MatrixXd& combinations) const;

  /// The modes become combinations of all columns. What the last of them take from the others
  /// becomes the only other columns: the directions that they went.
  /// @param of_modes (modes, modes)
  /// @param of_others (other columns, as many as are new), or nothing
  void combine(const Eigen::MatrixXd& of_modes, const Eigen::MatrixXd& of_others);

 private:
  struct Combination;

  template <typename Field>
  Eigen::MatrixXd rows_of(const Field& field, Eigen::Index first, Eigen::Index rows) const;
  template <typename Field>
  void combine_field(const Field& field, const Combination& combination);
  void project_new(const ElementOperator::Products& products);

  Ranks ranks_;
  Eigen::Index count_ = 0;  ///< of the columns of all blocks, which follow in this order
  Modes modes_;
  Block<float> gone_;
  Eigen::Index gone_count_ = 0;
  Modes new_;
  Eigen::MatrixXd stiffness_;
  Eigen::MatrixXd mass_;
};

}  // namespace flexneck::fe_modal
