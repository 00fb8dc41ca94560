// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::fe_modal {

/// Makes the calling thread run the BLAS and OpenMP on one thread: between the thousands of small
/// products of a factorisation threads wait for one another, and sums would come in another order
/// for each number of threads. Each session begins with this call.
void call_blas_alone();

/// Version and kernels of the BLAS, "OpenBLAS 0.3.21, SkylakeX", by which results differ in
/// rounding; "unknown" for another BLAS.
std::string blas_version();

}  // namespace flexneck::fe_modal
