// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/packed_matrix.h"
#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {

/// Sums of small symmetric matrices, which stay the same, with factors that change: the mass matrix
/// of an element from the masses at its integration points. Only the lower half of each is read.
class SymmetricSum {
 public:
  /// @param terms at least one; all of the same size, with at most 2^16 entries in the lower half
  explicit SymmetricSum(std::span<const Eigen::MatrixXd> terms);

  /// The sum of factors[k] terms[k]. The next call overwrites what is returned.
  /// @param factors as many as there are terms
  const PackedMatrix& with(const Eigen::VectorXd& factors, VectorRegisters registers);

 private:
  /// As many rows as keep the registers busy, each with sums of its own.
  static constexpr std::size_t kRowsTogether = 4;
  using Entries = std::array<RowOf<double>, kRowsTogether>;

  std::vector<Entries> halves_;  ///< lower halves of the terms: (group of entries, term)
  std::vector<Entries> half_sum_;
  std::vector<std::uint16_t> places_;  ///< of each entry of the sum in its half
  PackedMatrix sum_;
};

}  // namespace flexneck::fe_modal
