// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {

/// A dense block of a supernodal Cholesky factor, (rows, columns), column by column, with the
/// lower triangle of its columns on top.
template <typename Scalar>
struct FactorBlock {
  const Scalar* values;
  int rows;
  int columns;
};

/// With x = (b, 0), (rows): the columns' rows of x become L^-1 b, the others what the rows below
/// gain by it. A BLAS would pack the block first, which takes as long as the product.
void eliminate(const FactorBlock<double>& block, RowOf<double>* x,
               VectorRegisters registers = widest_registers());
void eliminate(const FactorBlock<float>& block, RowOf<float>* x,
               VectorRegisters registers = widest_registers());

/// The same for the transpose: of x the rows below the columns are known, and those of the columns
/// become L^-T (b - what those below take).
void substitute(const FactorBlock<double>& block, RowOf<double>* x,
                VectorRegisters registers = widest_registers());
void substitute(const FactorBlock<float>& block, RowOf<float>* x,
                VectorRegisters registers = widest_registers());

}  // namespace flexneck::fe_modal
