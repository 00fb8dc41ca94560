// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace flexneck::fe_modal {

/// A row of eight right-hand sides, on which the triangular solves work together: a factor, which
/// no cache holds, is read once for the eight.
template <typename Scalar>
struct alignas(8 * sizeof(Scalar)) RowOfEight {
  Scalar value[8];
};

/// A dense block of a supernodal Cholesky factor, (rows, columns), column by column, with the
/// lower triangle of its columns on top.
template <typename Scalar>
struct FactorBlock {
  const Scalar* values;
  int rows;
  int columns;
};

/// What the loops below are compiled for.
enum class VectorRegisters { of_16_bytes, of_32_bytes };

/// The widest that this processor has.
VectorRegisters widest_registers();

/// With x = (b, 0), (rows): the columns' rows of x become L^-1 b, the others what the rows below
/// gain by it. A BLAS would pack the block first, which takes as long as the product.
void eliminate(const FactorBlock<double>& block, RowOfEight<double>* x,
               VectorRegisters registers = widest_registers());
void eliminate(const FactorBlock<float>& block, RowOfEight<float>* x,
               VectorRegisters registers = widest_registers());

/// The same for the transpose: of x the rows below the columns are known, and those of the columns
/// become L^-T (b - what those below take).
void substitute(const FactorBlock<double>& block, RowOfEight<double>* x,
                VectorRegisters registers = widest_registers());
void substitute(const FactorBlock<float>& block, RowOfEight<float>* x,
                VectorRegisters registers = widest_registers());

}  // namespace flexneck::fe_modal
