// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// The processes that run an analysis together: all of them call the same functions in the same
/// order (SPMD). Vectors and matrices are distributed among them; small data is on each.
class Ranks {
 public:
  /// This process alone: a serial run.
  Ranks() = default;
  /// The processes that mpirun or a batch system has started together. MPI must be initialised.
  static Ranks all();

  int count() const { return count_; }
  int own() const { return own_; }
  bool are_many() const { return count_ > 1; }
  /// True for the rank that writes the files and prints.
  bool is_first() const { return own_ == 0; }

  /// Collective: number of ranks on this machine.
  int on_this_machine() const;

  /// Collective: replaces the values by their sums over all ranks, bitwise the same on each.
  void sum(Eigen::Ref<Eigen::MatrixXd> values) const;
  double sum(double value) const;
  /// Collective: returns the value of the first rank.
  std::uint64_t of_first(std::uint64_t value) const;
  /// Collective: runs `work` on every rank; then all or none of them continue: an exception of one
  /// rank is thrown on all with the same text, as an InputError if it was one.
  void together(const std::function<void()>& work) const;

 private:
  int count_ = 1;
  int own_ = 0;
};

/// Text of the exception in flight; for use in a handler.
std::string current_failure();

}  // namespace flexneck::fe_modal
