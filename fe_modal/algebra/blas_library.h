// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::fe_modal {

/// What the calling thread asks of the BLAS and of OpenMP it does alone: between the thousands of
/// small products of a factorisation threads wait for one another, and sums would come in another
/// order for each number of them. A session begins with it.
void call_blas_alone();

/// "OpenBLAS 0.3.21, SkylakeX", by which results differ in rounding; "unknown" of another BLAS.
std::string blas_version();

}  // namespace flexneck::fe_modal
