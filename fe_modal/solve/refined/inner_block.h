// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {

/// Degrees of freedom of a node, a block.
inline constexpr std::size_t kBlock = 3;
/// Where rows of groups of columns, one after the other for each degree of freedom, have a block's.
inline std::size_t first_row(std::size_t groups, std::int32_t block) {
  return groups * kBlock * static_cast<std::size_t>(block);
}

/// A block that one element alone has, as that of the middle node of a 27-node hexahedron has,
/// eliminated from it: three columns of a Cholesky factor, in single precision. The stars of the
/// element's corners, which all have the block, need not have it each.
class InnerBlock {
 public:
  /// Allocates what the columns take.
  /// @param numbers of the element's places, -1 where there is none
  /// @param place of the block among them
  InnerBlock(std::span<const std::int32_t> numbers, std::size_t place);

  /// @param numbers, place as before
  /// @param element stiffness, (3m, 3m) with degree of freedom a m + i; becomes the Schur
  ///     complement, in the rows of the other blocks
  /// @throws ComputationError if the block's own stiffness is not positive definite.
  void take_from(std::span<const std::int32_t> numbers, std::size_t place,
                 Eigen::MatrixXd& element);

  std::int32_t number() const { return numbers_.front(); }

  /// Rows are those of all blocks, `groups` groups of columns each.
  template <std::size_t lanes>
  void eliminate(std::size_t groups, std::span<RowOf<float, lanes>> rows) const;
  /// From the solutions of some stars that have the block, added up, the same of its own rows.
  /// @param eliminated rows after eliminate()
  /// @param count of these stars
  template <std::size_t lanes>
  void substitute(std::size_t groups, std::span<const RowOf<float, lanes>> eliminated,
                  std::size_t count, std::span<RowOf<float, lanes>> sums) const;

 private:
  std::vector<std::int32_t> numbers_;  ///< its own, then those that it is coupled with
  std::vector<float> entries_;         ///< (3 numbers, 3) of the factor, row by row
};

}  // namespace flexneck::fe_modal
