// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {

/// A dense block of a supernodal Cholesky factor, (rows, columns), column by column: the lower
/// triangle L11 on top of the rectangle L21.
template <typename Scalar>
struct FactorBlock {
  const Scalar* values;
  int rows;
  int columns;
};

/// Forward elimination: x = (b, 0) becomes (L11^-1 b, -L21 L11^-1 b). Of double and float. A BLAS
/// would pack the block first, which takes as long as the product. Of 8 columns together or, of
/// float, 16, which fill the widest register.
template <typename Scalar, std::size_t lanes>
void eliminate(const FactorBlock<Scalar>& block, RowOf<Scalar, lanes>* x,
               VectorRegisters registers = widest_registers());

/// Back substitution: x = (b, c) becomes (L11^-T (b - L21^T c), c).
template <typename Scalar, std::size_t lanes>
void substitute(const FactorBlock<Scalar>& block, RowOf<Scalar, lanes>* x,
                VectorRegisters registers = widest_registers());

}  // namespace flexneck::fe_modal
