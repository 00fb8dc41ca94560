// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// The processes that run an analysis together: all of them call the same functions in the same
/// order (SPMD). Vectors and matrices are distributed among them; whatever is small is on each.
class Ranks {
 public:
  /// This process alone.
  Ranks() = default;
  /// Those that mpirun or a batch system has started together. MPI must be initialised.
  static Ranks all();

  int count() const { return count_; }
  int own() const { return own_; }
  bool are_many() const { return count_ > 1; }
  /// The first one writes the files and prints.
  bool is_first() const { return own_ == 0; }

  /// Collective: how many run on the machine of this one.
  int on_this_machine() const;

  /// Collective: replaces the values by their sums over all ranks, the same bits on each.
  void sum(Eigen::Ref<Eigen::MatrixXd> values) const;
  double sum(double value) const;
  /// Collective: the value of the first rank.
  std::uint64_t of_first(std::uint64_t value) const;
  /// Collective: runs `work` on every rank, and then all or none of them go on: what one of them
  /// throws becomes an exception of the same text on all, an InputError if it was one.
  void together(const std::function<void()>& work) const;

 private:
  int count_ = 1;
  int own_ = 0;
};

/// In a handler: what was thrown, in words.
std::string current_failure();

}  // namespace flexneck::fe_modal
