// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::fe_modal {

/// OpenBLAS takes the kernels of the processor's model when it is loaded. For a model that is newer
/// than itself it takes those of 2004, of two numbers a register. This has it take those of the
/// vector units that the processor has: large products take a quarter of the time. Nothing happens
/// where OPENBLAS_CORETYPE is set, where OpenBLAS knows the model, and with another BLAS. A session
/// begins with it. Call it while no other thread is in the BLAS.
void choose_blas_kernels();

/// Of so many threads those that may call the BLAS at once: one where it has no locks, as OpenBLAS
/// built without threads, or is not known to have them.
unsigned threads_in_blas(unsigned threads);

/// What the calling thread asks of the BLAS it does alone: by several threads sums would come in
/// another order for each number of them. A session begins with it, and each thread that shall call
/// the BLAS: OpenMP has a number for each. OpenBLAS's own threads have one for the process.
void call_blas_alone();

/// "OpenBLAS 0.3.21, SkylakeX", by which results differ in rounding; "unknown" of another BLAS.
std::string blas_version();

}  // namespace flexneck::fe_modal
