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

/// Sums of the same small symmetric matrices with other factors each time, such as the mass of an
/// element from its points: half of each is read.
class SymmetricSum {
 public:
  /// @param terms some of one size, of at most 2^16 entries in one half
  explicit SymmetricSum(std::span<const Eigen::MatrixXd> terms);

  /// The sum of factors[k] terms[k], until the next one.
  const PackedMatrix& with(const Eigen::VectorXd& factors, VectorRegisters registers);

 private:
  /// As many rows as keep the registers busy, each with sums of its own.
  static constexpr std::size_t kRowsTogether = 4;
  using Entries = std::array<RowOf<double>, kRowsTogether>;

  std::size_t terms_count_;
  std::vector<Entries> halves_;  ///< so many entries of all terms, the next ones, and so on
  std::vector<Entries> half_sum_;
  std::vector<std::uint16_t> places_;  ///< of each entry of the sum in its half
  PackedMatrix sum_;
};

}  // namespace flexneck::fe_modal
